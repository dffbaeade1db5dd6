#![no_main]

#[path = "../../microsim-core/tests/common/sequence/mod.rs"]
mod sequence;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Err(wrong) = sequence::run(bytes, sequence::Limits::SHORT) {
        panic!("{wrong}");
    }
});
