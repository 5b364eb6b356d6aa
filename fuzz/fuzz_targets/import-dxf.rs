#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stargrip_cam_fuzz::run("import-dxf", bytes));
