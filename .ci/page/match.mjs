// A whole match by data channels, against the real server: a page in headless Chromium, another one as of a phone, and a bot outside
// of browsers. One page is silent for 5 s, the phone is loaded again, and a page in Firefox comes late and watches. The record of the
// match is played by the command line. Firefox needs a screen, such as that of xvfb-run.
//
//   xvfb-run -a node match.mjs SERVER PAGE BOT FOLDER     SERVER: microsim with the feature `serve`; PAGE: the built folder
//                                                         BOT: the game's example room_bot with the feature `webrtc`
//                                                         FOLDER: where pictures and records are kept
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import { createInterface } from "node:readline";
import { chromium } from "playwright-core";
import { serveRooms } from "./server.mjs";
import { openTab } from "./tab.mjs";

const [program, folder, bot, pictures] = process.argv.slice(2);
const CODE = "MATCH";
/** Time from a link to a moving cell that a machine with other work may take, ms; alone it is a tenth of it. */
const LONGEST_START = 30_000;
const LAPTOP = { viewport: { width: 480, height: 270 } };
const PHONE = { viewport: { width: 480, height: 240 }, deviceScaleFactor: 1, hasTouch: true, isMobile: true };

fs.mkdirSync(pictures, { recursive: true });
const { server, address } = await serveRooms(program, folder);
const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
        "--disable-background-timer-throttling", "--disable-renderer-backgrounding", "--disable-backgrounding-occluded-windows"],
});
const late = await openTab(LAPTOP.viewport);

/** Times frames, counts what is sent and what comes by either way, without signals, and lets the page be cut off or draw nothing. */
function watch() {
    globalThis.seen = { frames: [], socket: [0, 0], channel: [0, 0], bytes: [0, 0], isCut: false };
    const held = [];
    for (const [way, { prototype }] of Object.entries({ socket: WebSocket, channel: RTCDataChannel })) {
        const { send } = prototype;
        const { set } = Object.getOwnPropertyDescriptor(prototype, "onmessage");
        const note = (end, bytes) => {
            if (way === "socket" && (bytes[0] === 255 || bytes[1] === 255)) return;
            seen[way][end] += 1;
            seen.bytes[end] += bytes.length;
        };
        // Packets are lost while a connection is late.
        const pass = (act) => (!seen.isCut ? act() : way === "socket" ? held.push(act) : undefined);
        prototype.send = function (bytes) {
            note(0, bytes);
            pass(() => this.readyState === 1 || this.readyState === "open" ? send.call(this, bytes) : undefined);
        };
        Object.defineProperty(prototype, "onmessage", {
            set(take) {
                set.call(this, (event) => {
                    note(1, new Uint8Array(event.data));
                    pass(() => take(event));
                });
            },
        });
    }
    globalThis.cut = (time) => {
        seen.isCut = true;
        setTimeout(() => {
            seen.isCut = false;
            for (const act of held.splice(0)) act();
        }, time);
    };
    const { prototype } = WebGL2RenderingContext;
    const { drawElementsInstanced } = prototype;
    globalThis.draw = (isDrawn) => (prototype.drawElementsInstanced = isDrawn ? drawElementsInstanced : () => undefined) && undefined;
    const { requestAnimationFrame } = globalThis;
    globalThis.requestAnimationFrame = (frame) => requestAnimationFrame((time) => {
        const began = performance.now();
        frame(time);
        seen.frames.push(performance.now() - began);
    });
}

async function openPage(options) {
    const page = await (await browser.newContext(options)).newPage();
    page.on("pageerror", (error) => assert.fail(error));
    return page;
}

/** Takes a page into the room. */
async function enter(page, name) {
    await page.addInitScript(watch);
    await page.goto(`${address.origin}/?room=${CODE}&name=${name}&optics=drawn`);
}

/** Waits until a page shows the lobby with so many members. */
const lobby = (page, members) => page.waitForFunction(
    (members) => {
        const items = document.querySelectorAll("#items button");
        return items[0]?.textContent.startsWith("Ready") && items.length === 3 + members;
    }, members, { timeout: 180_000, polling: 20 });
/** Picks "Ready" in the list that screen readers see. */
const ready = (page) => page.evaluate(() => document.querySelector("#items button").click());
const picture = (page, name) => page.screenshot({ path: `${pictures}/${name}.png` });
const record = (page) => page.evaluate(() => localStorage.getItem("microsim/last-game.replay"));

/** Middle, 99th of a hundred and longest of some times. */
function spread(times) {
    const sorted = times.toSorted((a, b) => a - b);
    return [0.5, 0.99, 1].map((share) => sorted[Math.floor((sorted.length - 1) * share)].toFixed(1)).join("/");
}

function start(name, matches) {
    const found = { lines: [], process: spawn(bot, [address.host, CODE, name, String(matches), `${pictures}/bot.replay`], { stdio: ["ignore", "pipe", "inherit"] }) };
    createInterface({ input: found.process.stdout }).on("line", (line) => found.lines.push(line));
    found.line = async (pattern, time) => {
        const end = Date.now() + time;
        for (;;) {
            const match = found.lines.map((line) => pattern.exec(line)).find((match) => match);
            if (match) return match;
            assert.ok(Date.now() < end && found.process.exitCode === null, `no ${pattern} in ${found.lines}`);
            await new Promise((resolve) => setTimeout(resolve, 50));
        }
    };
    return found;
}

/** Waits until a page shows the match. */
const inMatch = (page) => page.waitForFunction(
    () => !document.querySelector("#items button")?.textContent.startsWith("Ready"), null, { timeout: 60_000, polling: 20 });
/** Waits until a page shows the lobby again, with what the match came to. */
const isOver = (page) => page.waitForFunction(
    () => document.querySelector("#items button")?.textContent.startsWith("Ready"), null, { timeout: 900_000, polling: 100 });

let program_of_bot;
try {
    const robot = start("Bot", 1);
    program_of_bot = robot.process;
    const phone = await openPage(PHONE);
    await enter(phone, "Phone");
    await lobby(phone, 2);

    // From the link to a cell that moves, without the time in which nothing is pressed.
    const began = Date.now();
    const laptop = await openPage(LAPTOP);
    await enter(laptop, "Ada");
    await lobby(laptop, 3);
    const shown = Date.now();
    await picture(laptop, "lobby");
    await ready(phone);
    const pressed = Date.now();
    await ready(laptop);
    await inMatch(laptop);
    await laptop.keyboard.down("ArrowRight");
    const [, moved] = await robot.line(/^player 2 moves at (\d+)/, 60_000);
    const [opening, beginning] = [shown - began, Number(moved) - pressed];
    console.log(`ok: from the link to a moving cell ${opening + beginning} ms: ${opening} to the lobby, ${beginning} from there`);
    assert.ok(opening + beginning < LONGEST_START);

    await laptop.keyboard.up("ArrowRight");
    await laptop.waitForTimeout(5000);
    await Promise.all([picture(laptop, "match-laptop"), picture(phone, "match-phone")]);
    await laptop.evaluate(() => cut(5000));
    await laptop.waitForTimeout(6000);

    await phone.reload();
    await lobby(phone, 3);
    await ready(phone);
    await inMatch(phone);
    await phone.waitForTimeout(2000);
    await picture(phone, "match-back");
    console.log("ok: a page is cut off for 5 s, and another one is loaded again and comes back");

    // Nobody looks at them meanwhile: three pages that draw in software take a minute to the first picture of the third.
    for (const page of [laptop, phone]) await page.evaluate(() => draw(false));
    await enter(late, "Late");
    await lobby(late, 4);
    for (const page of [laptop, phone]) await page.evaluate(() => draw(true));
    await ready(late);
    await inMatch(late);
    await late.waitForTimeout(2000);
    await picture(late, "match-late");
    console.log(`ok: who comes late watches, in ${late.name}`);

    const pages = { laptop, phone, late };
    // Nobody looks meanwhile, and drawing in software is what takes the time.
    const draw = (isDrawn) => Promise.all(Object.values(pages).map((page) => page.evaluate((isDrawn) => draw(isDrawn), isDrawn)));
    await draw(false);
    await Promise.all(Object.values(pages).map(isOver));
    await draw(true);
    await laptop.waitForTimeout(2000);
    for (const [name, page] of Object.entries(pages)) await picture(page, `end-${name}`);
    assert.deepEqual(late.complaints, []);
    const [line, digest] = await robot.line(/^match 1 digest (\w+) .* desync None .*/, 60_000);
    const ofBot = fs.readFileSync(`${pictures}/bot.replay`).toString("base64");
    console.log(`    ${line}`);
    for (const [name, page] of Object.entries(pages)) {
        const { frames, socket, channel, bytes } = await page.evaluate(() => seen);
        console.log(`    ${name}: ${frames.length} frames of ${spread(frames)} ms; messages up/down: relay ${socket.join("/")}, channels ${channel.join("/")}; bytes ${bytes.join("/")}`);
        assert.equal(await record(page), ofBot, name);
    }
    const played = JSON.parse(execFileSync(program, ["--quiet", "replay", "--json", `${pictures}/bot.replay`]));
    assert.ok(played.is_complete);
    assert.equal(played.digest, digest);
    console.log("ok: all have the same record at the end, no digest differed, and the command line plays it to the same one");
} finally {
    program_of_bot?.kill("SIGKILL");
    late.close();
    await browser.close();
    server.kill("SIGKILL");
}
