#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| microsim_game::network::hostile::packet(bytes));
