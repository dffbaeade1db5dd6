// Tests of the page in headless Chromium, with graphics in software.
//
//   node run.mjs PAGE GOLDEN [PICTURES [PART...]]     PAGE: the built folder; GOLDEN: microsim-core/tests/golden
//                                                     PART: a function below, such as `title`; all of them unless given
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { chromium } from "playwright-core";

const [folder, golden, pictures = fs.mkdtempSync("/tmp/microsim-page-"), ...wanted] = process.argv.slice(2);
const TYPES = { ".css": "text/css", ".html": "text/html", ".js": "text/javascript", ".png": "image/png",
    ".txt": "text/plain", ".wasm": "application/wasm", ".webmanifest": "application/manifest+json" };
const SIZE = { width: 640, height: 360 };

// A game that one cell wins in seconds: two pellets lie before it.
const TABLE = `schema = 1
name = "table"
[world]
size = [90.0, 50.0]
damping = 1.5
[game]
time = 12.0
[game.points.agar]
each = 10
[amoeboid_cell.cell]
radii = [8.0, 8.0]
speed = 12.0
[agar.pellet]
radius = 1.0
[[spawn]]
of = "cell"
player = true
at = [45.0, 25.0]
[[spawn]]
of = "pellet"
at = [57.0, 25.0]
[[spawn]]
of = "pellet"
at = [63.0, 25.0]
`;

// --- A server and a browser -------------------------------------------------------------------------------------------

const server = http.createServer((request, response) => {
    const name = path.join(folder, path.normalize(new URL(request.url, "http://page").pathname));
    const file = name.endsWith("/") ? `${name}index.html` : name;
    fs.readFile(file, (error, bytes) => {
        response.writeHead(error ? 404 : 200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream" });
        response.end(bytes);
    });
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const root = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
        "--ignore-gpu-blocklist"],
});
const complaints = [];

/** A fresh browser profile with one tab; what its console complains of is kept. */
async function profile(options = {}) {
    const context = await browser.newContext({ viewport: SIZE, acceptDownloads: true, ...options });
    const page = await context.newPage();
    page.on("console", (line) => ["error", "warning"].includes(line.type()) && !/GL Driver Message|GPU stall/.test(line.text()) && complaints.push(line.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    return page;
}

async function open(page, address) {
    const began = Date.now();
    await page.goto("about:blank");
    await page.goto(root + address);
    await page.locator("#loading").waitFor({ state: "hidden", timeout: 60_000 });
    return Date.now() - began;
}

/** Name and place of a picture that the game saves of itself. */
async function picture(page) {
    const waiting = page.waitForEvent("download", { timeout: 30_000 });
    await page.keyboard.press("F12", { delay: 300 });
    const download = await waiting;
    const name = download.suggestedFilename();
    const file = path.join(pictures, `${String(++pictureCount).padStart(2, "0")}-${name}`);
    await download.saveAs(file);
    return { name, file };
}
let pictureCount = 0;

async function screenshot(page, name) {
    const file = path.join(pictures, `${name}.png`);
    await page.screenshot({ path: file });
    return file;
}

/** How many different colours a picture has, and how bright it is on average. */
async function look(file) {
    const page = await browser.newPage();
    const found = await page.evaluate(async (data) => {
        const bitmap = await createImageBitmap(await (await fetch(data)).blob());
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data: texels } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        const colours = new Set();
        let sum = 0;
        for (let k = 0; k < texels.length; k += 4) {
            colours.add((texels[k] << 16) | (texels[k + 1] << 8) | texels[k + 2]);
            sum += texels[k] + texels[k + 1] + texels[k + 2];
        }
        return { colours: colours.size, mean: (4 * sum) / (3 * texels.length) };
    }, `data:image/png;base64,${fs.readFileSync(file, "base64")}`);
    await page.close();
    return found;
}

// --- Checks -----------------------------------------------------------------------------------------------------------

let passed = 0;
const failed = [];
function check(name, isGood, note = "") {
    if (isGood) passed += 1;
    else failed.push(name);
    console.log(`${isGood ? "ok     " : "FAILED "} ${name}${note === "" ? "" : `: ${note}`}`);
}
async function checkPicture(name, file) {
    const { colours, mean } = await look(file);
    check(`${name}: there is something to see`, colours > 500 && mean > 10, `${colours} colours, mean ${mean.toFixed(0)}`);
}
const kept = (page, name) => page.evaluate((name) => {
    const value = localStorage.getItem(`microsim/${name}`);
    return value === null ? null : atob(value);
}, name);

async function title() {
    const page = await profile();
    const cold = await open(page, "");
    const warm = await open(page, "");
    check("title: is there", true, `after ${cold} ms, then after ${warm} ms`);
    await page.waitForTimeout(1000);
    await checkPicture("title", await screenshot(page, "title"));
    await page.keyboard.press("Escape", { delay: 300 });
    const { name } = await picture(page);
    check("title: Escape does not end it, and a picture of it is downloaded", name === "microsim-title.png", name);
    await page.context().close();
}

async function digests() {
    const page = await profile();
    for (const simd of ["yes", "no"]) {
        await open(page, `?scenario=empty&optics=drawn&simd=${simd}`);
        for (const [name, expected] of goldenDigests()) {
            const found = await page.evaluate((name) => microsim.digest(name, 300), name);
            check(`digest after 300 steps, simd ${simd}: ${name}`, found === expected, `${found}, golden ${expected}`);
        }
    }
    await page.context().close();
}

/** Scenarios and their golden digests after 300 steps. */
function goldenDigests() {
    const digest = /^step 300 .*digest ([0-9a-f]{16})$/m;
    const files = fs.readdirSync(golden).filter((file) => file.endsWith(".txt")).sort();
    const found = files.map((file) => [path.basename(file, ".txt"), digest.exec(fs.readFileSync(path.join(golden, file), "utf8"))?.[1]]);
    return found.filter(([, expected]) => expected !== undefined);
}

/** Presses the key for the next optics until the settings say that it was seen. */
async function nextOptics(page, before) {
    await page.keyboard.press("o", { delay: 300 });
    const changed = await page.waitForFunction((before) => {
        const found = /sight = "(.*)"/.exec(atob(localStorage.getItem("microsim/settings.toml") ?? ""))?.[1];
        return found !== before && found;
    }, before, { timeout: 30_000 });
    return changed.jsonValue();
}

async function settings() {
    const page = await profile();
    await open(page, "?scenario=empty");
    const first = await nextOptics(page);
    await open(page, "?scenario=empty");
    const second = await nextOptics(page, first);
    await open(page, "?scenario=empty");
    const third = await nextOptics(page, second);
    check("settings: survive a reload", new Set([first, second, third]).size === 3, `${first}, ${second}, ${third}`);
    await page.evaluate(() => localStorage.setItem("microsim/settings.toml", btoa("sight = [")));
    await open(page, "?scenario=hunt&optics=drawn");
    check("settings: damaged ones are put aside", (await kept(page, "settings.broken")) === "sight = [");
    check("settings: and the game goes on", (await picture(page)).name.startsWith("microsim-hunt-"));
    await page.context().close();
}

/** Notes what the page plays: when, how long and how loud each piece of sound is. */
function listen() {
    globalThis.heard = [];
    const start = AudioBufferSourceNode.prototype.start;
    AudioBufferSourceNode.prototype.start = function (at) {
        const loudest = this.buffer.getChannelData(0).reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
        globalThis.heard.push({ at, time: this.buffer.duration, loudest });
        return start.call(this, at);
    };
}

/** Opens the table as a game, from a link. */
async function openTable(page) {
    await open(page, "?scenario=empty&optics=drawn");
    const link = await page.evaluate((text) => microsim.linkTo("scenario", new TextEncoder().encode(text)), TABLE);
    await open(page, `?play&optics=drawn#${link.split("#")[1]}`);
}

async function round() {
    const page = await profile();
    await page.addInitScript(listen);
    await openTable(page);
    await page.mouse.move(600, 180);
    await page.mouse.down();
    await page.waitForTimeout(4000);
    let name = "";
    for (let tries = 0; tries < 20 && !name.startsWith("microsim-end-"); tries += 1) {
        await page.waitForTimeout(2000);
        ({ name } = await picture(page));
    }
    await page.mouse.up();
    check("round: ends with a score", /^microsim-end-[1-9]\d*\.png$/.test(name), name);
    const heard = await page.evaluate(() => globalThis.heard);
    const loudest = Math.max(...heard.map((piece) => piece.loudest));
    const time = heard.reduce((sum, piece) => sum + piece.time, 0);
    check("round: is heard", loudest > 0.05 && loudest < 0.6 && time > 1, `${time.toFixed(2)} s, at most ${loudest.toFixed(2)}`);
    check("round: no sound is played over another", heard.every((piece, k) => k === 0 || piece.at > heard[k - 1].at + 0.99 * heard[k - 1].time));
    await checkPicture("round", await screenshot(page, "end"));
    check("round: the score is kept", /^points = [1-9]/m.test((await kept(page, "scores.toml")) ?? ""));
    await page.locator("#menu summary").click();
    await page.locator("#share").waitFor({ timeout: 5000 });
    check("round: its link is offered", true);
    const replay = await page.evaluate(() =>
        microsim.linkTo("replay", Uint8Array.from(atob(localStorage.getItem("microsim/last-game.replay")), (l) => l.charCodeAt(0))));
    await page.context().close();

    const other = await profile();
    await open(other, `?optics=drawn#${replay.split("#")[1]}`);
    const shown = (await picture(other)).name;
    check("round: its link shows the replay elsewhere", shown.startsWith("microsim-replay-of-table-"), `${shown}, ${replay.length} letters`);
    await other.context().close();
}

async function files() {
    const page = await profile();
    await open(page, "?optics=drawn");
    await page.locator("#files").setInputFiles({ name: "Tisch für zwei.toml", mimeType: "text/plain", buffer: Buffer.from(TABLE) });
    await page.waitForTimeout(1500);
    const { name } = await picture(page);
    check("files: a picked one is shown", name.startsWith("microsim-table-"), name);
    await page.locator("#menu summary").click();
    await page.locator("#share-scenario").waitFor({ timeout: 5000 });
    check("files: its link is offered", true);
    await page.context().close();

    const linked = await profile();
    const text = fs.readFileSync(path.join(golden, "../../scenarios/hunt.toml"), "utf8");
    await open(linked, "?scenario=empty&optics=drawn");
    const address = await linked.evaluate((text) => microsim.linkTo("scenario", new TextEncoder().encode(text)), text);
    await open(linked, `?optics=drawn#${address.split("#")[1]}`);
    const [same, built] = await linked.evaluate(() => ["linked.toml", "hunt"].map((name) => microsim.digest(name, 300)));
    check("files: a linked scenario is the same world", same === built, `${same}, ${address.length} letters`);
    await linked.context().close();
}

async function optics() {
    for (const [floats, words] of [["float targets", ""], ["byte targets", "&floats=no"]]) {
        const page = await profile();
        await open(page, `?scenario=demo&optics=phase-contrast&quality=high${words}`);
        await page.waitForTimeout(1500);
        await checkPicture(`optics with ${floats}`, await screenshot(page, floats.replace(" ", "-")));
        await page.context().close();
    }
}

async function hiding() {
    const page = await profile();
    await open(page, "?play&seed=1&optics=drawn");
    await page.evaluate(() => {
        Object.defineProperty(document, "visibilityState", { configurable: true, get: () => "hidden" });
        document.dispatchEvent(new Event("visibilitychange"));
    });
    await page.waitForTimeout(500);
    const { name } = await picture(page);
    check("hidden: the round pauses", name === "microsim-pause.png", name);
    await page.context().close();
}

async function phones() {
    for (const [width, height] of [[360, 740], [812, 375]]) {
        const page = await profile({ viewport: { width, height }, deviceScaleFactor: 3, hasTouch: true, isMobile: true });
        await open(page, "?optics=drawn");
        await page.waitForTimeout(1500);
        await checkPicture(`phone ${width}x${height}, title`, await screenshot(page, `phone-${width}-title`));
        await open(page, "?play&seed=1&optics=drawn");
        await page.waitForTimeout(1000);
        await checkPicture(`phone ${width}x${height}, round`, await screenshot(page, `phone-${width}-round`));
        check(`phone ${width}x${height}: has buttons`, await page.getByRole("button", { name: "Zoom in" }).isVisible());
        check(`phone ${width}x${height}: digestion needs none`, !(await page.getByRole("button", { name: "Digest" }).isVisible()));
        await page.touchscreen.tap(Math.round(0.8 * width), Math.round(0.3 * height));
        await page.getByRole("button", { name: "Menu", exact: true }).tap();
        await page.waitForTimeout(600);
        const { name } = await picture(page);
        check(`phone ${width}x${height}: the menu button pauses`, name === "microsim-pause.png", name);
        check(`phone ${width}x${height}: menus have no buttons`, !(await page.getByRole("button", { name: "Zoom in" }).isVisible()));
        await page.context().close();
    }
}

/** A round by two fingers: one steers, the other digests, for players who ask for a button. */
async function fingers() {
    const page = await profile({ viewport: { width: 812, height: 375 }, hasTouch: true, isMobile: true });
    await open(page, "");
    await page.evaluate(() => localStorage.setItem("microsim/settings.toml", btoa("hold_to_digest = true")));
    await openTable(page);
    const screen = await page.context().newCDPSession(page);
    const touch = (type, ...touchPoints) => screen.send("Input.dispatchTouchEvent", { type, touchPoints });
    const goal = { x: 700, y: 187, id: 0 };
    const { x, y, width, height } = await page.getByRole("button", { name: "Digest" }).boundingBox();
    await touch("touchStart", goal);
    await page.waitForTimeout(4000);
    await touch("touchStart", goal, { x: x + width / 2, y: y + height / 2, id: 1 });
    await page.waitForFunction(() => localStorage.getItem("microsim/last-game.replay") !== null, undefined, { timeout: 60_000 });
    await touch("touchEnd");
    check("fingers: a round ends with a score", /^points = [1-9]/m.test((await kept(page, "scores.toml")) ?? ""));
    await page.context().close();
}

async function offline() {
    const page = await profile();
    await open(page, "?scenario=empty&optics=drawn");
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.context().setOffline(true);
    await open(page, "?scenario=hunt&optics=drawn");
    const { name } = await picture(page);
    check("offline: the page opens without a network", name.startsWith("microsim-hunt-"), name);
    await page.context().close();
}

async function mistakes() {
    const before = complaints.length;
    for (const [address, expected] of [["?scenario=nonsense", "no built-in scenario"], ["?size=1x1", "not a size"],
        ["#scenario=nonsense", "the link is damaged"]]) {
        const page = await profile();
        await page.goto(root + address);
        await page.locator("#failure").waitFor({ timeout: 30_000 });
        const text = await page.locator("#problem").textContent();
        check(`mistake in the address: ${address} is answered on the page`, text.includes(expected), text.split("\n")[0]);
        await page.context().close();
    }
    complaints.length = before;
}

for (const part of [title, digests, settings, round, files, optics, hiding, phones, fingers, offline, mistakes]) {
    if (wanted.length > 0 && !wanted.includes(part.name)) continue;
    try {
        await part();
    } catch (error) {
        check(part.name, false, error.stack);
    }
}
check("no complaint in any console", complaints.length === 0, complaints.slice(0, 5).join(" | "));
console.log(`${passed} passed, ${failed.length} failed; pictures in ${pictures}`);
await browser.close();
server.close();
process.exit(failed.length === 0 ? 0 : 1);
