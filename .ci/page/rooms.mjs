// The page's side of rooms, against the real server.
//
//   node rooms.mjs SERVER WEB FOLDER ECHO     SERVER: microsim with the feature `serve`; WEB: microsim-game/web; FOLDER: is emptied
//                                             ECHO: the game's example room_echo with the feature `webrtc`
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { browser, close, echo, exchange, meshed, next, open as openAt, pair, serve } from "./members.mjs";

/** Has channels send what no page sends. */
function spoiled() {
    Object.assign(globalThis, { size: 0, times: 1 });
    const { send } = RTCDataChannel.prototype;
    RTCDataChannel.prototype.send = function (bytes) {
        for (let k = 0; k < times; k += 1) send.call(this, size ? new Uint8Array(size) : bytes);
    };
}

const address = await serve();
const open = (more = "", change) => openAt(address + more, change);

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
        await page.goto(address);
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
        const window = spawn(echo, [address, room], { stdio: "inherit" });
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
    await close();
}
