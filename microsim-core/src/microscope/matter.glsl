// What light meets, as phase, haemoglobin, cytoplasm and nucleus; see matter.rs.

// Middle of what is seen, micrometres, and clip units per micrometre.
uniform vec4 view;
// Side of a pixel, micrometres; size of the last step that the target can tell apart, or 0.
uniform vec2 pixel;
// Matter times scale is what the target holds, once its bias is added.
uniform vec4 scale;

#ifdef VERTEX
vec4 seen_at(vec2 place) {
    return vec4((place - view.xy) * view.zw, 0.0, 1.0);
}
#else
// Adds matter. Half a step more or less keeps thin things from being lost in a target of bytes.
void put(vec4 matter) {
    vec4 amount = matter * scale;
    vec4 dither = entry(floor(gl_FragCoord.xy) + floor(amount.x * 5e4)) - 0.5;
    gl_FragColor = amount + pixel.y * dither * step(vec4(1e-6), abs(amount));
}
#endif
