// Channels from this page to the other members of a room, without the server between (WebRTC). They are made by signals through the
// server: docs/network.md has the format. What comes from another member may be anything.

/** First byte of a signal; no message of the game begins with it. */
const SIGNAL = 255;
const OFFER = 0, ANSWER = 1, CANDIDATE = 2;
/** What the server itself says: first byte and kind. */
const NOTICE = 255, JOINED = 1, LEFT = 2, HELPERS = 4, BACK = 5;
/** Longest signal, bytes; most signals of an attempt, and most offers of a member. One may have been for who had this number before. */
const LONGEST_SIGNAL = 8192, MOST_SIGNALS = 64, MOST_OFFERS = 3;
/** Shortest time between two offers to a number, however often somebody comes with it, ms. */
const PAUSE = 2000;
/** Longest message of a channel, bytes: it fits in one packet. Longer ones go by the server. */
const LONGEST_MESSAGE = 1100;
/** Most messages of a channel in a second; a match of two has 60. */
const MOST_MESSAGES = 500;
/** Bytes that wait to be sent by a channel; what is more goes by the server. */
const MOST_UNSENT = 1 << 16;
/** Time without a message after which those to that member go both ways, ms. */
const SILENCE = 1500;
const decode = (bytes) => new TextDecoder().decode(bytes);
const CHANNEL = { negotiated: true, id: 0, ordered: false, maxRetransmits: 0 };

/** One way to another member; one that fails is not made again before that member comes again. */
class Way {
    #connection;
    #channel;
    #signals = 0;
    #heard = 0;
    #second = 0;
    #count = 0;

    /** `signal` sends one to that member, `receive` takes a message. */
    constructor(attempt, helpers, signal, receive) {
        this.attempt = attempt;
        this.signal = (kind, text) => signal([SIGNAL, kind, attempt, ...new TextEncoder().encode(text)]);
        this.#connection = new RTCPeerConnection({ iceServers: helpers });
        this.#channel = this.#connection.createDataChannel("", CHANNEL);
        this.#channel.binaryType = "arraybuffer";
        this.#channel.onopen = () => (this.#heard = performance.now());
        this.#channel.onmessage = ({ data }) => (this.#allows(data) ? receive(new Uint8Array(data)) : this.close());
        this.#connection.ondatachannel = () => this.close();
        this.#connection.onconnectionstatechange = () => this.#connection.connectionState === "failed" && this.close();
        this.#connection.onicecandidate = ({ candidate }) => candidate?.candidate && this.signal(CANDIDATE, candidate.candidate);
    }

    #allows(data) {
        const now = performance.now(), second = Math.floor(now / 1000);
        if (second !== this.#second) [this.#second, this.#count] = [second, 0];
        this.#count += 1;
        this.#heard = now;
        return data instanceof ArrayBuffer && data.byteLength > 0 && data.byteLength <= LONGEST_MESSAGE && this.#count <= MOST_MESSAGES;
    }

    async offer() {
        await this.#connection.setLocalDescription();
        this.signal(OFFER, this.#connection.localDescription.sdp);
    }

    /** Takes a signal of this attempt. */
    async take(kind, text) {
        this.#signals += 1;
        if (this.#signals > MOST_SIGNALS) return this.close();
        if (kind !== OFFER && kind !== ANSWER && kind !== CANDIDATE) return this.close();
        if (kind === CANDIDATE) return this.#connection.addIceCandidate({ candidate: text, sdpMLineIndex: 0 });
        if (text.match(/^m=/gm)?.length !== 1 || !/^m=application /m.test(text)) return this.close();
        await this.#connection.setRemoteDescription({ type: kind === OFFER ? "offer" : "answer", sdp: text });
        if (kind === ANSWER) return;
        await this.#connection.setLocalDescription();
        this.signal(ANSWER, this.#connection.localDescription.sdp);
    }

    /** Sends a message, and returns whether it need not go by the server as well. */
    send(message) {
        const isOpen = this.#connection.connectionState === "connected" && this.#channel.readyState === "open";
        if (!isOpen || message.length > LONGEST_MESSAGE || this.#channel.bufferedAmount > MOST_UNSENT) return false;
        this.#channel.send(message);
        return performance.now() - this.#heard < SILENCE;
    }

    close() {
        this.#connection.close();
    }
}

/** A signal that is of no use leaves the server's way. */
const quietly = (promise) => promise?.catch(() => {});

/** The channels of one room. */
export class Mesh {
    #ways = new Map();
    /** How many offers have come, by member. */
    #offers = new Map();
    /** Before when nobody is offered a way, and what waits for that, by member. */
    #pauses = new Map();
    #timers = new Map();
    #helpers = [];
    #attempts = 0;

    /** `signal` sends a frame to the server, `receive` takes one as if the server had sent it. */
    constructor(signal, receive) {
        Object.assign(this, { signal, receive });
    }

    /** Takes what the server has sent, and returns whether it was for nobody else. */
    take(frame) {
        const [first, kind, member] = frame;
        if (first !== NOTICE) {
            if (kind === SIGNAL) this.#hear(first, frame.subarray(2));
            return kind === SIGNAL;
        }
        if (kind === HELPERS) this.#helpers = JSON.parse(decode(frame.subarray(2)));
        const comes = kind === JOINED || kind === BACK;
        if (comes || kind === LEFT) this.#drop(member);
        // Who is there already offers a way to who comes.
        const wait = this.#pauses.get(member) - performance.now();
        if (comes && wait > 0) this.#timers.set(member, setTimeout(() => this.#offer(member), wait));
        else if (comes) this.#offer(member);
        return kind === HELPERS;
    }

    #offer(member) {
        this.#pauses.set(member, performance.now() + PAUSE);
        this.#offers.delete(member);
        this.#attempts = (this.#attempts + 1) % 256;
        quietly(this.#way(member, this.#attempts)?.offer());
    }

    /** Sends a message of a frame by a channel, and returns whether it need not go by the server as well. */
    send(frame) {
        return this.#ways.get(frame[0])?.send(frame.subarray(1)) ?? false;
    }

    close() {
        for (const member of [...this.#ways.keys(), ...this.#timers.keys()]) this.#drop(member);
    }

    #drop(member) {
        clearTimeout(this.#timers.get(member));
        this.#ways.get(member)?.close();
        this.#ways.delete(member);
    }

    /** A new way to a member; none where the browser makes none. */
    #way(member, attempt) {
        this.#drop(member);
        try {
            const signal = (bytes) => this.signal(Uint8Array.of(member, ...bytes));
            const receive = (message) => this.receive(Uint8Array.of(member, ...message));
            const way = new Way(attempt, this.#helpers, signal, receive);
            this.#ways.set(member, way);
            return way;
        } catch {
            return undefined;
        }
    }

    #hear(member, signal) {
        const [kind, attempt] = signal;
        if (signal.length < 2 || signal.length > LONGEST_SIGNAL) return;
        if (kind === OFFER) {
            const count = (this.#offers.get(member) ?? 0) + 1;
            this.#offers.set(member, count);
            if (count > MOST_OFFERS) return;
            this.#way(member, attempt);
        }
        const way = this.#ways.get(member);
        if (way?.attempt === attempt) quietly(way.take(kind, decode(signal.subarray(2))));
    }
}
