// Runs a WebAssembly build of `digests`: node run.mjs FILE.wasm
import { readFile } from 'node:fs/promises';

let memory;
const decoder = new TextDecoder();
const host = {
    print: (text, length) => console.log(decoder.decode(new Uint8Array(memory.buffer, text, length))),
};
const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]), { host });
memory = instance.exports.memory;
instance.exports.main(0, 0);
