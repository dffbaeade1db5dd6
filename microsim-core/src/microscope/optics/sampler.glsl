// Matter, waves and slopes at a pixel; see sampler.rs.

varying vec2 uv;
// Lower left corner of the target, and its size, micrometres.
uniform vec4 area;
#ifdef SURROUND
uniform sampler2D surround_target;
// From this target to the one of the surround wave: scale and offset.
uniform vec4 to_surround;

vec2 surround() {
    vec4 bytes = texture2D(surround_target, uv * to_surround.xy + to_surround.zw);
    return unkept(vec4(bytes.xy + bytes.zw / 255.0, 0.0, 0.0)).xy;
}
#endif

vec4 matter_here() {
    return matter_at(uv);
}

// Matter some micrometres beside this place.
vec4 matter_beside(vec2 offset) {
    return matter_at(uv + offset / area.zw);
}

// Delay there, radians.
float phase_beside(vec2 offset) {
    return matter_beside(offset).x;
}

// Curvature of the delay over a step, radians per square micrometre.
float curvature(float step) {
    float across = phase_beside(vec2(step, 0.0)) + phase_beside(vec2(-step, 0.0));
    float along = phase_beside(vec2(0.0, step)) + phase_beside(vec2(0.0, -step));
    return (across + along - 4.0 * matter_here().x) / (step * step);
}
