// The wave behind the specimen, and the surround wave; see wave.rs.

// What the target of matter holds, and how: matter is what it holds less the bias, over the scale.
uniform sampler2D matter_target;
uniform vec4 matter_scale;
uniform vec4 matter_bias;

vec4 matter_at(vec2 uv) {
    return (texture2D(matter_target, uv) - matter_bias) / matter_scale;
}

// The wave behind some matter, relative to the one behind nothing.
vec2 behind(vec4 matter) {
    return vec2(cos(matter.x), sin(matter.x)) * exp(-0.5 * GREEN_DENSITY * max(matter.y, 0.0));
}

// What shines in fluorescence.
vec2 emitted(vec4 matter) {
    return clamp(matter.wz, 0.0, 1.0);
}

// Waves are kept as colours.
vec4 kept(vec4 waves) {
    return 0.5 + 0.5 * waves / WAVE_RANGE;
}

vec4 unkept(vec4 colours) {
    return (colours * 2.0 - 1.0) * WAVE_RANGE;
}
