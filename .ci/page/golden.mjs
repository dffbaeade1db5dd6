import fs from "node:fs";
import path from "node:path";

/** Scenarios and their golden digests after 300 steps. */
export function goldenDigests(golden) {
    const digest = /^step 300 .*digest ([0-9a-f]{16})$/m;
    const files = fs.readdirSync(golden).filter((file) => file.endsWith(".txt")).sort();
    const found = files.map((file) => [path.basename(file, ".txt"), digest.exec(fs.readFileSync(path.join(golden, file), "utf8"))?.[1]]);
    return found.filter(([, expected]) => expected !== undefined);
}
