// A graphics context that comes back after a loss. A browser may take the graphics away, as after sleep, and gives back a context
// with nothing in it: so objects here remember the calls that made them what they are, and the context those that set its state.

/** Objects, those first that others are made of. */
const KINDS = ["Program", "UniformLocation", "Buffer", "Texture", "Renderbuffer", "Framebuffer", "VertexArray"];
/** Calls that are remembered, by whose they are: of those with equal first arguments, of so many, the last one counts. */
const CALLS = {
    State: {
        bindFramebuffer: 1, bindRenderbuffer: 1, bindVertexArray: 0, blendEquationSeparate: 0, blendFunc: 0, blendFuncSeparate: 0,
        clearColor: 0, clearDepth: 0, clearStencil: 0, colorMask: 0, cullFace: 0, depthFunc: 0, disable: 1, enable: 1, frontFace: 0,
        getExtension: 1, pixelStorei: 1, scissor: 0, stencilFuncSeparate: 1, stencilMaskSeparate: 1, stencilOpSeparate: 1,
        useProgram: 0, viewport: 0,
    },
    Buffer: { bufferData: 1, bufferSubData: 2 },
    Texture: { texImage2D: 2, texParameteri: 2, texSubImage2D: 4 },
    Renderbuffer: { renderbufferStorageMultisample: 1 },
    Framebuffer: { framebufferRenderbuffer: 2, framebufferTexture2D: 2 },
    VertexArray: {
        disableVertexAttribArray: 1, enableVertexAttribArray: 1, vertexAttribDivisor: 1, vertexAttribIPointer: 1, vertexAttribPointer: 1,
    },
};
/** Parts of names in which calls that set the same differ. */
const VARIANTS = /^(en|dis)able|Separate$|I(?=Pointer)/;
/** Calls after which what others have done is gone. */
const REPLACED = { bufferData: "bufferSubData", texImage2D: "texSubImage2D" };

/** What the loader has in place of an object of the context, which a loss makes worthless. */
class Handle {
    #name;

    constructor(kind, make) {
        Object.assign(this, { kind, make, real: make(), calls: new Map() });
    }

    /** The loader's number. */
    set name(number) {
        this.#name = number;
        if (this.real !== null) this.real.name = number;
    }

    remake() {
        this.real = this.make();
        this.name = this.#name;
    }
}

const real = (value) => (value instanceof Handle ? value.real : value);

/** A copy of a call's arguments; bytes go where those of the last call are, if there is room. */
function copied(values, last) {
    return values.map((value, k) => {
        if (!ArrayBuffer.isView(value)) return value;
        const room = last?.[k]?.buffer;
        const bytes = new Uint8Array(room?.byteLength >= value.byteLength ? room : new ArrayBuffer(value.byteLength), 0, value.byteLength);
        bytes.set(new Uint8Array(value.buffer, value.byteOffset, value.byteLength));
        return bytes;
    });
}

/** A stand-in for a WebGL 2 context; its `restore` makes again what a loss has taken. */
export function restorable(context) {
    const gl = {}, handles = new Set();
    const state = { calls: new Map() }, bound = new Map();
    let unit = context.TEXTURE0, vertexArray = new Handle("VertexArray", () => null);
    handles.add(vertexArray);

    for (const name in context) {
        const value = context[name];
        gl[name] = typeof value === "function" ? (...values) => context[name](...values.map(real)) : value;
    }
    /** Has `note` told of the calls of a function. */
    const watch = (name, note) => {
        const call = gl[name];
        gl[name] = (...values) => {
            const result = call(...values);
            note(values);
            return result;
        };
    };
    const added = (handle) => {
        if (handle.real !== null) handles.add(handle);
        return handle.real && handle;
    };
    /** Remembers a call, and another that has to come before it. */
    const remember = (owner, key, name, values, before) => {
        const last = owner.calls.get(key);
        owner.calls.set(key, { name, values: copied(values, last?.values), before });
    };
    const repeat = ({ name, values, before }) => {
        if (before) context[before[0]](...before.slice(1).map(real));
        context[name](...values.map(real));
    };

    // Which object a call is about, and the call that binds it.
    const owners = {
        State: () => [state],
        Buffer: (target) => [bound.get(target), ["bindBuffer", target, bound.get(target)]],
        Texture: (target) => [bound.get(`${unit} ${target}`), ["bindTexture", target, bound.get(`${unit} ${target}`)]],
        Renderbuffer: (target) => [bound.get(target), ["bindRenderbuffer", target, bound.get(target)]],
        Framebuffer: (target) => [bound.get(target), ["bindFramebuffer", target, bound.get(target)]],
        VertexArray: () => [vertexArray, ["bindBuffer", context.ARRAY_BUFFER, bound.get(context.ARRAY_BUFFER)]],
    };
    for (const [kind, calls] of Object.entries(CALLS)) {
        for (const [name, count] of Object.entries(calls)) {
            watch(name, (values) => {
                const [owner, before] = owners[kind](values[0]);
                if (name in REPLACED) owner.calls.forEach((_, key) => key.startsWith(REPLACED[name]) && owner.calls.delete(key));
                remember(owner, [name.replace(VARIANTS, ""), ...values.slice(0, count)].join(), name, values, before);
            });
        }
    }
    for (const kind of KINDS.slice(2)) {
        gl[`create${kind}`] = () => added(new Handle(kind, () => context[`create${kind}`]()));
    }
    for (const kind of ["Program", ...KINDS.slice(2)]) {
        watch(`delete${kind}`, ([handle]) => {
            handles.delete(handle);
            handle.real = null;
        });
    }
    for (const kind of ["Framebuffer", "Renderbuffer", "Buffer"]) watch(`bind${kind}`, ([target, handle]) => bound.set(target, handle));
    watch("bindBuffer", ([target, handle]) => {
        const owner = target === context.ELEMENT_ARRAY_BUFFER ? vertexArray : state;
        remember(owner, `buffer ${target}`, "bindBuffer", [target, handle]);
    });
    const noArray = vertexArray;
    watch("bindVertexArray", ([handle]) => (vertexArray = handle ?? noArray));
    watch("activeTexture", ([chosen]) => (unit = chosen));
    watch("bindTexture", ([target, handle]) => {
        bound.set(`${unit} ${target}`, handle);
        remember(state, `texture ${unit} ${target}`, "bindTexture", [target, handle], ["activeTexture", unit]);
    });

    // Programs are linked again from the sources of their shaders, with attributes where they were.
    gl.createShader = (type) => Object.assign(new Handle("Shader", () => context.createShader(type)), { type });
    watch("shaderSource", ([shader, source]) => (shader.source = source));
    gl.createProgram = () => {
        const parts = [], attributes = new Map();
        const build = () => {
            const program = context.createProgram();
            for (const { type, source } of parts) {
                const shader = context.createShader(type);
                context.shaderSource(shader, source);
                context.compileShader(shader);
                context.attachShader(program, shader);
            }
            attributes.forEach((place, name) => context.bindAttribLocation(program, place, name));
            if (parts.length > 0) context.linkProgram(program);
            return program;
        };
        return Object.assign(added(new Handle("Program", build)), { parts, attributes });
    };
    watch("attachShader", ([program, shader]) => program.parts.push(shader));
    gl.getAttribLocation = (program, name) => {
        const place = context.getAttribLocation(program.real, name);
        if (place >= 0) program.attributes.set(name, place);
        return place;
    };
    gl.getUniformLocation = (program, name) => added(new Handle("UniformLocation", () => context.getUniformLocation(program.real, name)));

    /** To be called when the context has come back. */
    function restore() {
        const all = KINDS.flatMap((kind) => [...handles].filter((handle) => handle.kind === kind));
        const states = [...state.calls.values()];
        states.filter(({ name }) => name === "getExtension" || name === "pixelStorei").forEach(repeat);
        all.forEach((handle) => handle.remake());
        for (const handle of all) {
            if (handle.kind === "VertexArray") context.bindVertexArray(handle.real);
            [...handle.calls.values()].forEach(repeat);
        }
        states.forEach(repeat);
        context.bindVertexArray(vertexArray.real);
        context.activeTexture(unit);
    }
    return { gl, restore };
}
