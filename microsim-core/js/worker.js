// An example: a world that steps in a worker of a page and posts its organisms sixty times a second.
//
//   const worker = new Worker("worker.js", { type: "module" });
//   worker.onmessage = ({ data }) => draw(data.organisms);
//   worker.postMessage({ open: "hunt" });
//   worker.postMessage({ goal: { x: 60, y: 30 } });
import { load } from "./index.js";

const loading = load();
let world;

async function receive({ open, goal }) {
    const microsim = await loading;
    if (open) {
        world?.close();
        world = microsim.open(open);
    }
    if (goal && world?.player !== undefined) world.steer(world.player, goal);
}

// Before the program is there: what came without a receiver would be lost. Errors go to the page's `onerror`.
onmessage = ({ data }) => receive(data).catch(reportError);

setInterval(() => {
    if (!world) return;
    world.step();
    postMessage({ time: world.time, organisms: world.organisms });
}, 1000 / 60);
