// Tests of the page in headless Chromium, with graphics in software.
//
//   node run.mjs PAGE GOLDEN [PICTURES [PART...]]     PAGE: the built folder; GOLDEN: microsim-core/tests/golden
//                                                     PART: a function below, such as `title`; all of them unless given
import fs from "node:fs";
import path from "node:path";
import { check, checkPicture, complaints, finish, golden, kept, look, open, picture, profile, root, screenshot, wanted } from "./browser.mjs";
import { goldenDigests } from "./golden.mjs";

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
    await Promise.all(["yes", "no"].map(async (simd) => {
        const page = await profile();
        await open(page, `?scenario=empty&optics=drawn&simd=${simd}`);
        for (const [name, expected] of goldenDigests(golden)) {
            const found = await page.evaluate((name) => microsim.digest(name, 300), name);
            check(`digest after 300 steps, simd ${simd}: ${name}`, found === expected, `${found}, golden ${expected}`);
        }
        await page.context().close();
    }));
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
    check("files: a picked game is played", /^microsim-table-\d+-0\b/.test(name), name);
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

/** Menus are drawn, but their items are buttons of the page as well, for screen readers and for the Tab key. */
async function menus() {
    const page = await profile();
    await open(page, "?optics=drawn");
    const items = (screen) => page.getByRole("group", { name: screen, exact: true }).getByRole("button");
    const focused = () => page.evaluate(() => document.activeElement.textContent);
    const titles = await items("title").allTextContents();
    check("menus: those of the title are in the page", titles.join() === "Play,Slides,Food chain,Two players,Over the network,Simulation,Field guide,High scores,Settings", titles.join());
    await page.keyboard.press("Tab", { delay: 100 });
    check("menus: the Tab key leads to them", (await focused()) === "Play", await focused());
    for (let k = 1; k < titles.length; k += 1) {
        await page.keyboard.press("ArrowDown", { delay: 100 });
        await page.waitForFunction((title) => document.activeElement.textContent === title, titles[k], { timeout: 10_000 });
    }
    await page.keyboard.press("Enter", { delay: 100 });
    const sound = page.getByRole("button", { name: /^Sound: / });
    await sound.waitFor({ timeout: 10_000 });
    const before = await sound.textContent();
    await sound.focus();
    await page.keyboard.press("ArrowLeft", { delay: 100 });
    await page.waitForFunction((before) => document.activeElement.textContent !== before, before, { timeout: 10_000 });
    check("menus: values are changed by keys", /^Sound: /.test(await focused()), `${before}, then ${await focused()}`);
    await page.keyboard.press("Escape", { delay: 100 });
    await items("title").first().waitFor({ timeout: 10_000 });
    await items("title").filter({ hasText: /^Play$/ }).dispatchEvent("click");
    await items("title").first().waitFor({ state: "detached", timeout: 10_000 });
    check("menus: a click starts a round, which has no menu", (await page.locator("#items button").count()) === 0);
    await page.context().close();
}

/** The field guide, whose articles are fetched when they are asked for. */
async function guide() {
    const page = await profile();
    await open(page, "?optics=drawn");
    const items = (screen) => page.getByRole("group", { name: screen, exact: true }).getByRole("button");
    await items("title").filter({ hasText: /^Field guide$/ }).dispatchEvent("click");
    await items("guide").filter({ hasText: /^\? Pseudopod$/ }).waitFor({ timeout: 10_000 });
    check("guide: has titles", (await items("guide").count()) === 29, `${await items("guide").count()}`);
    await items("guide").filter({ hasText: /^Drawing$/ }).dispatchEvent("click");
    await items("article-drawn").first().waitFor({ timeout: 10_000 });
    await page.waitForTimeout(1000); // a picture is taken
    await checkPicture("guide, an article", await screenshot(page, "guide-article"));
    await page.context().close();
}

/** The page is in the browser's language, offline too, or in that of the address. */
async function languages() {
    const page = await profile({ locale: "cs-CZ" });
    await open(page, "?optics=drawn");
    const title = (text) => page.getByRole("button", { name: text, exact: true }).waitFor({ timeout: 10_000 });
    await title("Hrát");
    check("languages: Czech in a Czech browser", (await page.evaluate(() => document.documentElement.lang)) === "cs");
    const own = () => page.evaluate(() => [document.getElementById("open").textContent, document.querySelector("summary").ariaLabel]);
    check("languages: the page's own texts too", (await own()).join() === "Otevřít soubor,Soubory, odkazy a soukromí");
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.context().setOffline(true);
    await open(page, "?optics=drawn");
    await title("Potravní řetězec");
    check("languages: without a network too", true);
    await page.context().setOffline(false);
    await open(page, "?optics=drawn&language=en");
    await title("Food chain");
    check("languages: English if the address says so", (await page.evaluate(() => document.documentElement.lang)) === "en");
    check("languages: so are the page's own texts", (await own()).join() === "Open a file,Files, links and privacy");
    await page.context().close();
}

/** A browser may take the graphics away, and give them back with nothing in them. */
async function loss() {
    for (const optics of ["drawn", "phase-contrast"]) {
        const page = await profile();
        await open(page, `?play&seed=1&optics=${optics}&quality=low`);
        await page.waitForTimeout(1500);
        await page.keyboard.press("Escape", { delay: 300 });
        await page.waitForTimeout(500);
        const before = await look(await screenshot(page, `before-loss-${optics}`));
        await page.evaluate(async () => {
            const loss = gl.getExtension("WEBGL_lose_context");
            loss.loseContext();
            await new Promise((ended) => setTimeout(ended, 500));
            loss.restoreContext();
        });
        await page.waitForTimeout(1500);
        const after = await look(await screenshot(page, `after-loss-${optics}`));
        const isSame = Math.abs(before.mean - after.mean) < 2 && after.colours > 0.8 * before.colours;
        check(`loss, ${optics}: the picture comes back`, isSame, `${JSON.stringify(before)}, then ${JSON.stringify(after)}`);
        await page.keyboard.press("Escape", { delay: 300 });
        const { name } = await picture(page);
        check(`loss, ${optics}: the round goes on`, /^microsim-game-\d/.test(name), name);
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
        check(`phone ${width}x${height}: a round has a button to lunge`, await page.getByRole("button", { name: "Lunge" }).isVisible());
        check(`phone ${width}x${height}: a round has no button to divide`, !(await page.getByRole("button", { name: "Divide" }).isVisible()));
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

/** A food chain by fingers: a button divides the cell, and the end has a link to the same water. */
async function foodChain() {
    const page = await profile({ viewport: { width: 812, height: 375 }, hasTouch: true, isMobile: true });
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await open(page, "?scenario=food-chain&play&seed=7&optics=drawn");
    const divide = page.getByRole("button", { name: "Divide", exact: true });
    await divide.waitFor();
    await divide.tap();
    await checkPicture("food chain: a button divides", await screenshot(page, "food-chain"));
    await page.getByRole("button", { name: "Same water" }).waitFor({ timeout: 180_000 });
    check("food chain: its end has no such button", !(await divide.isVisible()));
    await checkPicture("food chain: its end", await screenshot(page, "food-chain-end"));
    await page.getByLabel("Files, links and privacy").tap();
    await page.getByRole("button", { name: "Copy a link to the last water" }).tap();
    await page.locator("#told", { hasText: "copied" }).waitFor();
    const link = await page.evaluate(() => navigator.clipboard.readText());
    check("food chain: the link leads to the same water", link === `${root}?scenario=food-chain&play&seed=7`, link);
    await page.context().close();
}

/** A gamepad moves through menus and steers; the browser's own is replaced by one that the test presses. */
async function gamepads() {
    const page = await profile();
    await page.addInitScript(() => {
        const pad = { mapping: "standard", axes: [0, 0, 0, 0], buttons: Array.from({ length: 17 }, () => ({ pressed: false })) };
        globalThis.pad = pad;
        navigator.getGamepads = () => [null, pad];
    });
    const press = async (button) => {
        await page.evaluate((button) => (globalThis.pad.buttons[button].pressed = true), button);
        await page.waitForTimeout(400);
        await page.evaluate((button) => (globalThis.pad.buttons[button].pressed = false), button);
        await page.waitForTimeout(400);
    };
    const [A, B, START, UP, DOWN] = [0, 1, 9, 12, 13];
    await open(page, "?optics=drawn");
    // Who is new begins at the slides.
    await press(UP);
    await press(DOWN);
    await press(A);
    check("gamepads: the cross and A open the slides", (await picture(page)).name === "microsim-slides.png");
    await press(B);
    check("gamepads: B leads back", (await picture(page)).name === "microsim-title.png");
    await openTable(page);
    await page.evaluate(() => (globalThis.pad.axes[0] = 1));
    await page.waitForTimeout(1000);
    await press(START);
    check("gamepads: Start pauses", (await picture(page)).name === "microsim-pause.png");
    await press(START);
    let name = "";
    for (let tries = 0; tries < 20 && !name.startsWith("microsim-end-"); tries += 1) {
        await page.waitForTimeout(2000);
        ({ name } = await picture(page));
    }
    check("gamepads: the stick leads to food", /^microsim-end-[1-9]\d*\.png$/.test(name), name);
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

for (const part of [title, menus, guide, languages, digests, settings, round, files, optics, loss, hiding, phones, fingers, foodChain, gamepads, offline, mistakes]) {
    if (wanted.length > 0 && !wanted.includes(part.name)) continue;
    try {
        await part();
    } catch (error) {
        check(part.name, false, error.stack);
    }
}
await finish();
