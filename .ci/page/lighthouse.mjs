// What Lighthouse says of the page: node lighthouse.mjs PAGE
import lighthouse from "lighthouse";
import { check, debugPort, finish, root } from "./browser.mjs";

const LEAST = 95;

const result = await lighthouse(root, {
    port: debugPort, onlyCategories: ["accessibility", "best-practices"], logLevel: "error", maxWaitForLoad: 60_000,
});
const { categories, audits } = result.lhr;
for (const { title, score, auditRefs } of Object.values(categories)) {
    const wrong = auditRefs.filter(({ id, weight }) => weight > 0 && audits[id].score !== null && audits[id].score < 1);
    check(`Lighthouse, ${title}: ${Math.round(100 * score)}`, 100 * score >= LEAST, wrong.map(({ id }) => audits[id].title).join("; "));
}
await finish();
