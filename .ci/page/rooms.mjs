// The page's side of rooms in headless Chromium, against the real server and under the page's own security policy. The program
// is not needed: its place is taken by the memory that it would have.
//
//   node rooms.mjs SERVER WEB FOLDER     SERVER: microsim with the feature `serve`; WEB: microsim-game/web; FOLDER: is made anew
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import fs from "node:fs";
import { chromium } from "playwright-core";

const [program, web, folder] = process.argv.slice(2);
fs.rmSync(folder, { recursive: true, force: true });
fs.mkdirSync(folder, { recursive: true });
for (const name of ["index.html", "host.js", "style.css"]) fs.copyFileSync(`${web}/${name}`, `${folder}/${name}`);
fs.writeFileSync(`${folder}/gl.js`, "let wasm_memory = { buffer: new ArrayBuffer(1 << 20) };");
fs.writeFileSync(`${folder}/start.js`, `
    import { functions } from "./host.js";
    const put = (at, bytes) => (new Uint8Array(wasm_memory.buffer).set(bytes, at), [at, bytes.length]);
    const text = (at, text) => put(at, new TextEncoder().encode(text));
    globalThis.tell = (what, name, bytes) => functions.microsim_tell(...text(0, what), ...text(100, name), ...put(200, bytes));
    globalThis.ask = (what, name) => {
        const length = functions.microsim_ask(...text(0, what), ...text(100, name));
        if (length < 0) return null;
        functions.microsim_take(200);
        return [...new Uint8Array(wasm_memory.buffer, 200, length)];
    };
    globalThis.enter = (number, code) => tell("enter room", number, new TextEncoder().encode(code));`);

const server = spawn(program, ["--quiet", "serve", "--port", "0", "--listen", "127.0.0.1", "--page", folder]);
const [line] = await once(server.stdout, "data");
const address = new URL(String(line).trim());
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });

async function open() {
    const page = await (await browser.newContext()).newPage();
    await page.goto(address.href);
    await page.waitForFunction("globalThis.enter");
    return page;
}

/** The next frame of a room. */
async function next(page, number) {
    const found = await page.waitForFunction((number) => ask("room", number), number, { timeout: 10_000 });
    return found.jsonValue();
}

try {
    const [one, two] = [await open(), await open()];
    await one.evaluate(() => enter("0", "ROOM"));
    assert.deepEqual(await next(one, "0"), [255, 0, 0]);
    await two.evaluate(() => enter("0", "room"));
    assert.deepEqual(await next(two, "0"), [255, 0, 1, 0]);
    assert.deepEqual(await next(one, "0"), [255, 1, 1]);
    await one.evaluate(() => tell("send", "0", [1, 7, 8]));
    assert.deepEqual(await next(two, "0"), [0, 7, 8]);
    assert.equal(await two.evaluate(() => ask("room", "0")), null);
    console.log("ok: two pages meet in a room");

    await two.evaluate(() => (tell("leave room", "0", []), enter("1", "ROOM")));
    assert.deepEqual(await next(one, "0"), [255, 2, 1]);
    assert.deepEqual(await next(two, "1"), [255, 0, 1, 0]);
    console.log("ok: a page leaves and comes back");

    // The reason comes first, then what the page adds.
    await one.evaluate(() => tell("send", "0", [9]));
    const [, kind, ...reason] = await next(one, "0").then((frame) => (frame[1] === 1 ? next(one, "0") : frame));
    assert.equal(kind, 3);
    assert.match(String.fromCharCode(...reason), /receiver/);
    assert.deepEqual(await next(one, "0"), [255, 3]);
    console.log("ok: a page is told why it is dropped");

    const other = await two.evaluate(() => new Promise((end) => {
        document.addEventListener("securitypolicyviolation", ({ violatedDirective }) => end(violatedDirective));
        try {
            new WebSocket("ws://elsewhere.example/room/ROOM");
        } catch (error) {
            end(String(error));
        }
    }));
    assert.equal(other, "connect-src");
    console.log("ok: a page speaks to no other server");
} finally {
    await browser.close();
    server.kill("SIGKILL");
}
