// A browser that opens the built page, and checks of what it shows.
import fs from "node:fs";
import path from "node:path";
import { chromium } from "playwright-core";
import { freePort, serve } from "./server.mjs";

export const [folder, golden, pictures = fs.mkdtempSync("/tmp/microsim-page-"), ...wanted] = process.argv.slice(2);
const SIZE = { width: 640, height: 360 };

// --- A browser ----------------------------------------------------------------------------------------------------

export const root = await serve(folder);
export const debugPort = await freePort();
export const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: [`--remote-debugging-port=${debugPort}`, "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
        "--ignore-gpu-blocklist"],
});
export const complaints = [];

/** A fresh browser profile with one tab; what its console complains of is kept. */
export async function profile(options = {}) {
    const context = await browser.newContext({ viewport: SIZE, acceptDownloads: true, ...options });
    const page = await context.newPage();
    page.on("console", (line) => ["error", "warning"].includes(line.type()) && !/GL Driver Message|GPU stall/.test(line.text()) && complaints.push(line.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    return page;
}

export async function open(page, address) {
    const began = Date.now();
    await page.goto("about:blank");
    await page.goto(root + address);
    await page.locator("#loading").waitFor({ state: "hidden", timeout: 60_000 });
    return Date.now() - began;
}

/** Name and place of a picture that the game saves of itself. */
export async function picture(page) {
    const waiting = page.waitForEvent("download", { timeout: 30_000 });
    await page.keyboard.press("F12", { delay: 300 });
    const download = await waiting;
    const name = download.suggestedFilename();
    const file = path.join(pictures, `${String(++pictureCount).padStart(2, "0")}-${name}`);
    await download.saveAs(file);
    return { name, file };
}
let pictureCount = 0;

export async function screenshot(page, name) {
    const file = path.join(pictures, `${name}.png`);
    await page.screenshot({ path: file });
    return file;
}

/** How many different colours a picture has, and how bright it is on average. */
export async function look(file) {
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
export function check(name, isGood, note = "") {
    if (isGood) passed += 1;
    else failed.push(name);
    console.log(`${isGood ? "ok     " : "FAILED "} ${name}${note === "" ? "" : `: ${note}`}`);
}
export async function checkPicture(name, file) {
    const { colours, mean } = await look(file);
    check(`${name}: there is something to see`, colours > 500 && mean > 10, `${colours} colours, mean ${mean.toFixed(0)}`);
}
export const kept = (page, name) => page.evaluate((name) => {
    const value = localStorage.getItem(`microsim/${name}`);
    return value === null ? null : atob(value);
}, name);

/** Says how many checks passed, and ends. */
export async function finish() {
    check("no complaint in any console", complaints.length === 0, complaints.slice(0, 5).join(" | "));
    console.log(`${passed} passed, ${failed.length} failed; pictures in ${pictures}`);
    await browser.close();
    process.exit(failed.length === 0 ? 0 : 1);
}
