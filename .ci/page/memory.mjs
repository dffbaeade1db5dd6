// Memory of the page under random input, by hand: it takes minutes.
//
//   node memory.mjs PAGE [MINUTES]     MINUTES: 5 unless given
//
// The last minute may need a tenth more than the first one.
import { check, finish, open, profile } from "./browser.mjs";

const minutes = Number(process.argv[3] ?? 5);
const KEYS = ["Escape", "Enter", "ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "o", "b", "p", "q", "a", "d", "r", "n", " ", ",", ".", "Tab"];

const page = await profile();
await open(page, "?play&quality=low");
const session = await page.context().newCDPSession(page);
let state = 1;
/** A whole number below a limit (xorshift). */
function random(limit) {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) % limit;
}

/** Bytes of the program's memory and of objects of the page that are in use. */
async function memory() {
    await session.send("HeapProfiler.collectGarbage");
    const { usedSize } = await session.send("Runtime.getHeapUsage");
    return [await page.evaluate(() => wasm_memory.buffer.byteLength), usedSize];
}

const most = [];
for (let minute = 0; minute < minutes; minute += 1) {
    const end = Date.now() + 60_000;
    let found = [0, 0], inputs = 0;
    while (Date.now() < end) {
        for (let k = 0; k < 20; k += 1, inputs += 1) {
            if (random(3) > 0) await page.keyboard.press(KEYS[random(KEYS.length)], { delay: 20 });
            else await page.mouse.click(random(640), random(360), { delay: 20 });
        }
        const now = await memory();
        found = found.map((bytes, k) => Math.max(bytes, now[k]));
    }
    most.push(found);
    console.log(`    minute ${minute + 1}: ${inputs} inputs, ${found.map((bytes) => (bytes / 1e6).toFixed(1)).join(" MB and ")} MB`);
}
const sum = ([program, objects]) => program + objects;
const growth = sum(most.at(-1)) / sum(most[0]) - 1;
check(`memory of the last minute is ${(100 * growth).toFixed(1)} % above that of the first`, growth <= 0.1);
await finish();
