// The page in Firefox, with graphics in software: draws the title and a round, computes the digests. Needs a screen, such as that of xvfb-run.
//
//   xvfb-run -a node firefox.mjs PAGE GOLDEN [PICTURES]     GOLDEN: microsim-core/tests/golden
import { spawn } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import WebSocket from "ws";
import { goldenDigests } from "./golden.mjs";
import { freePort, serve } from "./server.mjs";

const [folder, golden, pictures = fs.mkdtempSync("/tmp/microsim-firefox-")] = process.argv.slice(2);
const root = await serve(folder);
const port = await freePort();
const profile = fs.mkdtempSync("/tmp/microsim-firefox-profile-");
fs.writeFileSync(path.join(profile, "user.js"), ["webgl.force-enabled", "gfx.webgl.force-software"].map((name) => `user_pref("${name}", true);\n`)
    .concat(`user_pref("webgl.forbid-software", false);\n`).join(""));
const firefox = spawn("firefox-esr", ["--no-remote", "--profile", profile, "--remote-debugging-port", port], {
    env: { ...process.env, MOZ_DISABLE_CONTENT_SANDBOX: "1", LIBGL_ALWAYS_SOFTWARE: "1", HOME: profile }, stdio: "ignore",
});
const sleep = (time) => new Promise((ended) => setTimeout(ended, time));

// --- WebDriver BiDi ---------------------------------------------------------------------------------------------------

async function connect() {
    for (let tries = 0; ; tries += 1) {
        const socket = new WebSocket(`ws://127.0.0.1:${port}/session`);
        try {
            await new Promise((ready, refused) => socket.once("open", ready).once("error", refused));
            return socket;
        } catch (error) {
            if (tries === 60) throw error;
            await sleep(1000);
        }
    }
}
const socket = await connect();
const complaints = [], waiting = new Map();
socket.on("message", (data) => {
    const { id, method, params, result, error, message } = JSON.parse(data);
    if (method === "log.entryAdded" && ["error", "warn"].includes(params.level)) complaints.push(params.text);
    if (id) waiting.get(id)(error ? Promise.reject(new Error(message)) : result);
});
let count = 0;
const call = (method, params = {}) => new Promise((ended) => {
    waiting.set((count += 1), ended);
    socket.send(JSON.stringify({ id: count, method, params }));
});

const { capabilities } = await call("session.new", { capabilities: {} });
console.log(`    ${capabilities.browserName} ${capabilities.browserVersion}`);
await call("session.subscribe", { events: ["log.entryAdded"] });
const { context } = (await call("browsingContext.getTree")).contexts[0];
await call("browsingContext.setViewport", { context, viewport: { width: 960, height: 540 } });
const evaluate = async (expression) =>
    (await call("script.evaluate", { expression, target: { context }, awaitPromise: true })).result?.value;

// --- Checks -----------------------------------------------------------------------------------------------------------

let failed = 0;
function check(name, isGood, note = "") {
    failed += isGood ? 0 : 1;
    console.log(`${isGood ? "ok     " : "FAILED "} Firefox: ${name}${note === "" ? "" : `: ${note}`}`);
}

/** How many colours the canvas shows. */
const COLOURS = `new Promise((found) => requestAnimationFrame(() => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
    wasm_exports.frame();
    copy.drawImage(canvas, 0, 0);
    const texels = new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    found(new Set(texels).size);
}))`;
for (const [name, address] of [["title", ""], ["round", "?play&seed=1&quality=low"]]) {
    const began = Date.now();
    await call("browsingContext.navigate", { context, url: root + address, wait: "complete" });
    while (Date.now() - began < 60_000 && !(await evaluate("document.getElementById('loading').hidden"))) await sleep(100);
    const took = Date.now() - began;
    await sleep(2000);
    const { data } = await call("browsingContext.captureScreenshot", { context });
    fs.writeFileSync(path.join(pictures, `firefox-${name}.png`), Buffer.from(data, "base64"));
    const colours = await evaluate(COLOURS);
    check(`the ${name} is drawn`, colours > 500, `after ${took} ms, ${colours} colours`);
}
for (const [name, expected] of goldenDigests(golden)) {
    const found = await evaluate(`microsim.digest("${name}", 300)`);
    check(`digest after 300 steps: ${name}`, found === expected, `${found}, golden ${expected}`);
}
check("no complaint in the console", complaints.length === 0, complaints.slice(0, 5).join(" | "));
await call("browser.close").catch(() => {});
firefox.kill();
console.log(`    pictures in ${pictures}`);
process.exit(failed === 0 ? 0 : 1);
