// Pages in headless Chromium that are members of rooms, under the page's own security policy. The program is not needed: its place
// is taken by the memory that it would have.
import assert from "node:assert/strict";
import fs from "node:fs";
import { chromium } from "playwright-core";
import { serveRooms } from "./server.mjs";

export const [program, web, folder, echo] = process.argv.slice(2);
fs.rmSync(folder, { recursive: true, force: true });
fs.mkdirSync(folder, { recursive: true });
for (const name of ["index.html", "host.js", "mesh.js", "style.css"]) fs.copyFileSync(`${web}/${name}`, `${folder}/${name}`);
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

export const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
const servers = [];

/** Serves the page with these options; returns the address of a room. */
export async function serve(...options) {
    const { server, address } = await serveRooms(program, folder, ...options);
    servers.push(server);
    return address.href;
}

export async function close() {
    await browser.close();
    for (const server of servers) server.kill("SIGKILL");
}

/** Counts what is sent by either way, without signals, and the connections that are made. */
function count() {
    globalThis.sent = { socket: 0, channel: 0, connections: 0 };
    for (const [way, { prototype }] of Object.entries({ socket: WebSocket, channel: RTCDataChannel })) {
        const { send } = prototype;
        prototype.send = function (bytes) {
            if (way === "channel" || bytes[1] !== 255) sent[way] += 1;
            send.call(this, bytes);
        };
    }
    globalThis.RTCPeerConnection = class extends RTCPeerConnection {
        constructor(settings) {
            super({ ...settings, ...globalThis.changed });
            sent.connections += 1;
        }
    };
}

/** A page at an address, whose scripts find it changed. */
export async function open(address, change = () => {}) {
    const page = await (await browser.newContext()).newPage();
    page.on("pageerror", (error) => assert.fail(error));
    await page.addInitScript(change);
    await page.addInitScript(count);
    await page.goto(address);
    await page.waitForFunction("globalThis.enter");
    return page;
}

/** The next frame of a room. */
export async function next(page, number) {
    const found = await page.waitForFunction((number) => ask("room", number), number, { timeout: 10_000 });
    return found.jsonValue();
}

/** Members 0 and 1 of a new room. */
export async function pair(room, one, two) {
    for (const page of [one, two]) {
        await page.evaluate((room) => enter(room, room), room);
        await next(page, room);
    }
    await next(one, room);
}

/** Sends 20 messages with numbers, sees that they arrive, and returns how many went which way. */
export async function exchange(room, from, to, receiver, length = 60) {
    await from.evaluate(([room, receiver, length]) => {
        sent.socket = sent.channel = 0;
        for (let number = 0; number < 20; number += 1) tell("send", room, [receiver, number, ...Array(length - 1).fill(0)]);
    }, [room, receiver, length]);
    const come = new Set();
    while (come.size < 20) {
        const [, number, ...rest] = await next(to, room);
        if (rest.length === length - 1) come.add(number);
    }
    const { socket, channel } = await from.evaluate(() => sent);
    return [socket, channel];
}

/** Waits until what is said is not sent by the server any more. */
export async function meshed(room, from, receiver) {
    await from.waitForFunction(([room, receiver]) => {
        sent.socket = 0;
        tell("send", room, [receiver, 0]);
        return sent.socket === 0;
    }, [room, receiver], { polling: 50, timeout: 10_000 });
}
