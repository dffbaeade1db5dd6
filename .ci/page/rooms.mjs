// The page's side of rooms in headless Chromium, against the real server and under the page's own security policy. The program
// is not needed: its place is taken by the memory that it would have.
//
//   node rooms.mjs SERVER WEB FOLDER ECHO     SERVER: microsim with the feature `serve`; WEB: microsim-game/web; FOLDER: is emptied
//                                             ECHO: the game's example room_echo with the feature `webrtc`
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import fs from "node:fs";
import { chromium } from "playwright-core";

const [program, web, folder, echo] = process.argv.slice(2);
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

const server = spawn(program, ["--quiet", "serve", "--port", "0", "--listen", "127.0.0.1", "--page", folder]);
const [line] = await once(server.stdout, "data");
const address = new URL(String(line).trim());
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });

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

/** Has channels send what no page sends. */
function spoiled() {
    Object.assign(globalThis, { size: 0, times: 1 });
    const { send } = RTCDataChannel.prototype;
    RTCDataChannel.prototype.send = function (bytes) {
        for (let k = 0; k < times; k += 1) send.call(this, size ? new Uint8Array(size) : bytes);
    };
}

async function open(more = "", change = () => {}) {
    const page = await (await browser.newContext()).newPage();
    page.on("pageerror", (error) => assert.fail(error));
    await page.addInitScript(change);
    await page.addInitScript(count);
    await page.goto(address.href + more);
    await page.waitForFunction("globalThis.enter");
    return page;
}

/** The next frame of a room. */
async function next(page, number) {
    const found = await page.waitForFunction((number) => ask("room", number), number, { timeout: 10_000 });
    return found.jsonValue();
}

/** Members 0 and 1 of a new room. */
async function pair(room, one, two) {
    for (const page of [one, two]) {
        await page.evaluate((room) => enter(room, room), room);
        await next(page, room);
    }
    await next(one, room);
}

/** Sends 20 messages with numbers, sees that they arrive, and returns how many went which way. */
async function exchange(room, from, to, receiver, length = 60) {
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
async function meshed(room, from, receiver) {
    await from.waitForFunction(([room, receiver]) => {
        sent.socket = 0;
        tell("send", room, [receiver, 0]);
        return sent.socket === 0;
    }, [room, receiver], { polling: 50, timeout: 10_000 });
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

    await two.evaluate(() => tell("leave room", "0", []));
    assert.deepEqual(await next(one, "0"), [255, 2, 1]);
    await two.evaluate(() => enter("1", "ROOM"));
    assert.deepEqual(await next(two, "1"), [255, 0, 1, 0]);
    console.log("ok: a page leaves and comes back");

    // The reason comes first, then what the page adds.
    await one.evaluate(() => tell("send", "0", [9]));
    const [, kind, ...reason] = await next(one, "0").then((frame) => (frame[1] === 1 ? next(one, "0") : frame));
    assert.equal(kind, 3);
    assert.match(String.fromCharCode(...reason), /receiver/);
    assert.deepEqual(await next(one, "0"), [255, 3]);
    console.log("ok: a page is told why it is dropped");

    await pair("MESH", one, two);
    await Promise.all([meshed("MESH", one, 1), meshed("MESH", two, 0)]);
    assert.deepEqual(await exchange("MESH", one, two, 1), [0, 20]);
    assert.deepEqual(await exchange("MESH", two, one, 0), [0, 20]);
    console.log("ok: what two pages say goes by their channel alone");

    assert.deepEqual(await exchange("MESH", one, two, 1, 1200), [20, 0]);
    await one.waitForTimeout(1600);
    assert.deepEqual(await exchange("MESH", one, two, 1), [20, 20]);
    console.log("ok: long messages go by the server, and those to who is silent go both ways");

    const [shy, blocked] = [await open("&direct=no"), await open("", () => (globalThis.changed = { iceTransportPolicy: "relay" }))];
    for (const [room, partner] of [["QUIET", shy], ["BLOCKED", blocked]]) {
        await pair(room, one, partner);
        await partner.waitForTimeout(1000);
        assert.deepEqual(await exchange(room, one, partner, 1), [20, 0]);
        assert.deepEqual(await exchange(room, partner, one, 0), [20, 0]);
    }
    assert.deepEqual(await shy.evaluate(() => sent.connections), 0);
    console.log("ok: the server carries what has no channel");

    for (const [room, spoil] of [["LONG", () => (size = 1500)], ["OFTEN", () => (times = 2000)]]) {
        const bad = await open("", spoiled);
        await pair(room, one, bad);
        await Promise.all([meshed(room, one, 1), meshed(room, bad, 0)]);
        // The limit counts seconds of the clock: all comes in one of them, and from who is heard, by the channel alone.
        await one.waitForFunction(() => performance.now() % 1000 < 50, null, { polling: 10 });
        await one.evaluate((room) => tell("send", room, [1, 7]), room);
        await next(bad, room);
        await one.evaluate((room) => { while (ask("room", room)); }, room);
        await bad.evaluate(spoil);
        await bad.evaluate((room) => tell("send", room, [0, 7]), room);
        await one.waitForTimeout(500);
        const frames = await one.evaluate((room) => {
            let count = 0;
            for (let frame; (frame = ask("room", room)); count += 1) if (frame[0] === 255) return "it has left the room";
            return count;
        }, room);
        assert.ok(frames <= 500, frames);
        assert.deepEqual(await exchange(room, one, bad, 1), [20, 0]);
    }
    console.log("ok: a channel with too much in it is closed");

    for (const page of [one, two]) {
        await page.evaluate((code) => enter("BACK", code), page === one ? "BACK" : "BACK?key=a1b2c3");
        await next(page, "BACK");
    }
    await Promise.all([meshed("BACK", one, 1), meshed("BACK", two, 0)]);
    await one.evaluate(() => { while (ask("room", "BACK")); });
    await two.evaluate(() => enter("AGAIN", "BACK?key=a1b2c3"));
    assert.deepEqual(await next(two, "AGAIN"), [255, 0, 1, 0]);
    assert.deepEqual(await next(one, "BACK"), [255, 5, 1]);
    await Promise.all([meshed("BACK", one, 1), meshed("AGAIN", two, 0)]);
    console.log("ok: who comes back has a new channel");

    // As "duplicate tab" does: a page of the same browser with the same key.
    const context = await browser.newContext();
    const tab = async (key) => {
        const page = await context.newPage();
        await page.addInitScript((key) => (sessionStorage.roomKey ??= key), key);
        await page.goto(address.href);
        await page.waitForTimeout(500);
        return page;
    };
    const keys = (pages) => Promise.all(pages.map((page) => page.evaluate(() => sessionStorage.roomKey)));
    const tabs = [await tab("a"), await tab("a"), await tab("b")];
    assert.deepEqual(await keys(tabs), ["a", undefined, "b"]);
    await tabs[0].reload();
    await tabs[0].waitForTimeout(500);
    assert.deepEqual(await keys(tabs), ["a", undefined, "b"]);
    await context.close();
    console.log("ok: a tab that is duplicated gets a key of its own, and one that is loaded again keeps its key");

    // A page that offers, and one that answers.
    for (const room of ["OFFERS", "ANSWERS"]) {
        const page = await open();
        let relayed = 0;
        page.on("websocket", (socket) => socket.on("framereceived", ({ payload }) => (relayed += payload[0] !== 255 && payload[1] !== 255)));
        const enter = () => page.evaluate((room) => globalThis.enter(room, room), room);
        if (room === "OFFERS") await enter().then(() => next(page, room));
        const window = spawn(echo, [address.href, room], { stdio: "inherit" });
        try {
            if (room === "ANSWERS") {
                await page.waitForTimeout(500);
                await enter();
            }
            await next(page, room);
            const other = room === "OFFERS" ? 1 : 0;
            await meshed(room, page, other);
            relayed = 0;
            assert.deepEqual(await exchange(room, page, page, other), [0, 20]);
            assert.equal(relayed, 0);
        } finally {
            window.kill("SIGKILL");
        }
    }
    console.log("ok: a page and a window speak by their channel alone");

    const junk = await open("&direct=no");
    await pair("JUNK", one, junk);
    const before = await one.evaluate(() => sent.connections);
    await junk.evaluate(() => {
        const say = (...bytes) => tell("send", "JUNK", [0, 255, ...bytes]);
        const text = (text) => new TextEncoder().encode(text);
        for (let k = 0; k < 200; k += 1) say(k % 4, k % 3, ...text(`m=application 9 x${k}\r\n`));
        say();
        say(2, 1, ...text("candidate:1 1 udp 1 elsewhere.example 1 typ host"));
        say(0, 1, ...Array(9000).fill(10));
    });
    assert.deepEqual(await exchange("JUNK", junk, one, 0), [20, 0]);
    assert.ok(await one.evaluate(() => sent.connections) - before <= 3);
    assert.deepEqual(await exchange("JUNK", one, junk, 1), [20, 0]);
    console.log("ok: signals that are none change nothing");

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
