# Everything a person or CI does here. Only cargo is needed, except for `strangers`, which installs its own readers.

CARGO ?= cargo

.PHONY: demo test check strangers bench docs

# Build the paper's star and say what was written, and where.
demo:
	$(CARGO) run --release --locked -- build designs/paper-five-points.toml

test:
	$(CARGO) test --locked

# What CI runs first: format, lints, the tests in debug, the golden files in release, the documentation.
check:
	$(CARGO) fmt --check
	$(CARGO) clippy --locked --all-targets -- -D warnings
	$(MAKE) test
	$(CARGO) test --locked --release --test golden
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --no-deps --document-private-items

# Readers that no one here wrote, on every output of every shipped design. Needs root for apt-get.
strangers:
	$(CARGO) build --release --locked
	tests/strangers/run

bench:
	$(CARGO) bench --locked
