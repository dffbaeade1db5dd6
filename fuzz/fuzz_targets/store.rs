#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| microsim_cli::hostile::store(bytes));
