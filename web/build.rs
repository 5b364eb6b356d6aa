//! How the page's program is linked: with the stack of a main thread elsewhere, since specs and drawings may nest; and with numbers of
//! functions as short as they can be, not of five bytes each as the linker leaves them, which it does only without debug information.

/// Bytes of the stack.
const STACK: u32 = 8 << 20;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_ARCH").as_deref() == Ok("wasm32") {
        println!("cargo::rustc-link-arg-cdylib=-zstack-size={STACK}");
        if std::env::var("DEBUG").as_deref() == Ok("false") {
            println!("cargo::rustc-link-arg-cdylib=--strip-debug");
            println!("cargo::rustc-link-arg-cdylib=--compress-relocations");
        }
    }
}
