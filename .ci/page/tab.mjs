// A tab of Firefox, with graphics in software, driven by WebDriver BiDi: it has those functions of Playwright's pages that the tests
// call. It needs a screen, such as that of xvfb-run.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import WebSocket from "ws";
import { freePort } from "./server.mjs";

const SETTINGS = { "webgl.force-enabled": true, "gfx.webgl.force-software": true, "webgl.forbid-software": false };
const sleep = (time) => new Promise((ended) => setTimeout(ended, time));

function start(port) {
    const profile = fs.mkdtempSync(path.join(os.tmpdir(), "microsim-firefox-"));
    fs.writeFileSync(path.join(profile, "user.js"), Object.entries(SETTINGS).map(([name, value]) => `user_pref("${name}", ${value});\n`).join(""));
    const browser = spawn("firefox-esr", ["--no-remote", "--profile", profile, "--remote-debugging-port", port], {
        env: { ...process.env, MOZ_DISABLE_CONTENT_SANDBOX: "1", LIBGL_ALWAYS_SOFTWARE: "1", HOME: profile }, stdio: "ignore",
    });
    process.on("exit", () => browser.kill());
    return browser;
}

async function connect(port) {
    for (let tries = 0; ; tries += 1) {
        const socket = new WebSocket(`ws://127.0.0.1:${port}/session`);
        try {
            await once(socket, "open");
            return socket;
        } catch (error) {
            if (tries === 60) throw error;
            await sleep(1000);
        }
    }
}

class Tab {
    /** What the console complained of. */
    complaints = [];
    #waiting = new Map();
    #count = 0;
    #context;

    constructor(socket, browser) {
        Object.assign(this, { socket, browser });
        socket.on("message", (data) => {
            const { id, method, params, result, error, message } = JSON.parse(data);
            if (method === "log.entryAdded" && ["error", "warn"].includes(params.level)) this.complaints.push(params.text);
            if (id) this.#waiting.get(id)(error ? Promise.reject(new Error(message)) : result);
        });
    }

    async begin(viewport) {
        const { capabilities } = await this.#call("session.new", { capabilities: {} });
        this.name = `${capabilities.browserName} ${capabilities.browserVersion}`;
        await this.#call("session.subscribe", { events: ["log.entryAdded"] });
        this.#context = (await this.#call("browsingContext.getTree")).contexts[0].context;
        await this.#call("browsingContext.setViewport", { context: this.#context, viewport });
    }

    #call(method, params = {}) {
        return new Promise((ended) => {
            this.#waiting.set((this.#count += 1), ended);
            this.socket.send(JSON.stringify({ id: this.#count, method, params }));
        });
    }

    addInitScript(script) {
        return this.#call("script.addPreloadScript", { functionDeclaration: String(script) });
    }

    goto(url) {
        return this.#call("browsingContext.navigate", { context: this.#context, url, wait: "complete" });
    }

    /** What an expression, or a function of an argument, comes to. */
    async evaluate(script, argument) {
        const value = typeof script === "function" ? `(${script})(${JSON.stringify(argument) ?? ""})` : script;
        const target = { context: this.#context };
        const expression = `Promise.resolve(${value}).then(JSON.stringify)`;
        const { result, exceptionDetails } = await this.#call("script.evaluate", { expression, target, awaitPromise: true });
        assert.equal(exceptionDetails?.text, undefined);
        return result.value && JSON.parse(result.value);
    }

    async waitForFunction(script, argument, { timeout, polling }) {
        const end = Date.now() + timeout;
        while (!(await this.evaluate(script, argument))) {
            assert.ok(Date.now() < end, `${this.name}: after ${timeout} ms not yet: ${script}`);
            await sleep(polling);
        }
    }

    waitForTimeout(time) {
        return sleep(time);
    }

    async screenshot({ path }) {
        const { data } = await this.#call("browsingContext.captureScreenshot", { context: this.#context });
        fs.writeFileSync(path, Buffer.from(data, "base64"));
    }

    close() {
        this.socket.close();
        this.browser.kill();
    }
}

/** The tab of a Firefox that is started, of this size. */
export async function openTab(viewport) {
    const port = await freePort();
    const browser = start(port);
    const tab = new Tab(await connect(port), browser);
    await tab.begin(viewport);
    return tab;
}
