//! The mechanics of hinges and stars.
