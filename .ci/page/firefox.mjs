// The page in Firefox, with graphics in software: draws the title and a round, computes the digests. Needs a screen, such as that of xvfb-run.
//
//   xvfb-run -a node firefox.mjs PAGE GOLDEN [PICTURES]     GOLDEN: microsim-core/tests/golden
import fs from "node:fs";
import path from "node:path";
import { goldenDigests } from "./golden.mjs";
import { serve } from "./server.mjs";
import { openTab } from "./tab.mjs";

const [folder, golden, pictures = fs.mkdtempSync("/tmp/microsim-firefox-")] = process.argv.slice(2);
const root = await serve(folder);
const tab = await openTab({ width: 960, height: 540 });
console.log(`    ${tab.name}`);

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
    await tab.goto(root + address);
    await tab.waitForFunction("document.getElementById('loading').hidden", null, { timeout: 60_000, polling: 100 });
    const took = Date.now() - began;
    await tab.waitForTimeout(2000);
    await tab.screenshot({ path: path.join(pictures, `firefox-${name}.png`) });
    const colours = await tab.evaluate(COLOURS);
    check(`the ${name} is drawn`, colours > 500, `after ${took} ms, ${colours} colours`);
}
for (const [name, expected] of goldenDigests(golden)) {
    const found = await tab.evaluate(`microsim.digest("${name}", 300)`);
    check(`digest after 300 steps: ${name}`, found === expected, `${found}, golden ${expected}`);
}
check("no complaint in the console", tab.complaints.length === 0, tab.complaints.slice(0, 5).join(" | "));
tab.close();
console.log(`    pictures in ${pictures}`);
process.exit(failed === 0 ? 0 : 1);
