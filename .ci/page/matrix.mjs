// What a match costs over networks of all kinds, in headless Chromium: the game's example `network_matrix`, of which the page is the
// clock, the command line and the console.
//
//   node matrix.mjs PROGRAM [FRAMES [LATENCY | faults | light]]     PROGRAM: as .ci/wasm builds it
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { chromium } from "playwright-core";
import { serve } from "./server.mjs";

const [program, ...words] = process.argv.slice(2);

/** Runs the program with these words. What else the window's library imports is not called. */
async function run(words) {
    const answer = new TextEncoder().encode(["network_matrix", ...words].join("\n"));
    let memory;
    const textAt = (at, length) => new TextDecoder().decode(new Uint8Array(memory.buffer, at, length));
    const env = {
        microsim_now: () => performance.now(),
        microsim_ask: () => answer.length,
        microsim_take: (to) => new Uint8Array(memory.buffer).set(answer, to),
        microsim_tell: (_what, _whatLength, _name, _nameLength, text, length) => console.log(textAt(text, length)),
    };
    const module = await WebAssembly.compileStreaming(fetch("program.wasm"));
    for (const { name } of WebAssembly.Module.imports(module)) env[name] ??= () => { throw new Error(name); };
    const { exports } = await WebAssembly.instantiate(module, { env });
    ({ memory } = exports);
    exports.main();
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "microsim-matrix-"));
fs.copyFileSync(program, `${folder}/program.wasm`);
fs.writeFileSync(`${folder}/index.html`, "");
// An isolated page has a clock of 5 us; others have one of 100.
const root = await serve(folder, { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" });
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
console.log(`Chromium ${browser.version()}`);
try {
    const page = await browser.newPage();
    page.on("console", (line) => line.type() === "log" && console.log(line.text()));
    await page.goto(root);
    await page.evaluate(run, words);
} finally {
    await browser.close();
    fs.rmSync(folder, { recursive: true });
}
process.exit();
