#![no_main]

libfuzzer_sys::fuzz_target!(|line: &[u8]| {
    microsim_cli::hostile::checkpoint(line);
});
