// Channels by a TURN server, coturn of Debian, where it is installed.
//
//   node turn.mjs SERVER WEB FOLDER     as rooms.mjs
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { close, exchange, folder, meshed, open, pair, serve } from "./members.mjs";
import { freePort } from "./server.mjs";

/** Time in which a channel would be there, ms: with a right password it takes a tenth of it. */
const LONG_ENOUGH = 3000;

const port = await freePort();
const relay = spawn("turnserver", ["-n", "--listening-ip=127.0.0.1", "--relay-ip=127.0.0.1", `--listening-port=${port}`,
    "--allow-loopback-peers", "--lt-cred-mech", "--user=ada:right", "--realm=microsim", `--userdb=${folder}/users`,
    `--pidfile=${folder}/process`, "--no-tls", "--no-dtls", "--no-cli", "--log-file=stdout"], { stdio: "ignore" });

/** Two members of a room who may go by the TURN server alone. */
async function members(password) {
    const address = await serve(`--turn=ada:${password}@127.0.0.1:${port}`);
    const member = () => open(address, () => (globalThis.changed = { iceTransportPolicy: "relay" }));
    const found = [await member(), await member()];
    await pair("TURN", ...found);
    return found;
}

try {
    await once(relay, "spawn");
    const [one, two] = await members("right");
    const began = performance.now();
    await Promise.all([meshed("TURN", one, 1), meshed("TURN", two, 0)]);
    const took = performance.now() - began;
    assert.deepEqual(await exchange("TURN", one, two, 1), [0, 20]);
    assert.deepEqual(await exchange("TURN", two, one, 0), [0, 20]);
    console.log(`ok: a TURN server carries a channel, after ${took.toFixed(0)} ms`);

    const [three, four] = await members("wrong");
    await three.waitForTimeout(LONG_ENOUGH);
    assert.deepEqual(await exchange("TURN", three, four, 1), [20, 0]);
    assert.deepEqual(await exchange("TURN", four, three, 0), [20, 0]);
    console.log("ok: it carries none with a wrong password, and messages go by the server");
} catch (error) {
    if (error.path !== "turnserver") throw error;
    console.log("SKIPPED TURN: not installed: turnserver");
} finally {
    relay.kill("SIGKILL");
    await close();
}
