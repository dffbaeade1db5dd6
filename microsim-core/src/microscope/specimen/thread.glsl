// Thin straight threads; see thread.rs.

// Along the thread in its lengths, and across it in its radii.
varying vec2 local;
// Length in radii, place of the peak.
varying vec2 measures;
varying vec4 body;

#ifdef VERTEX
attribute vec2 from;
attribute vec2 to;
attribute vec2 corner;
// Half its width, place of the peak.
attribute vec2 form;
attribute vec4 matter;

void main() {
    float blur = 0.7 * pixel.x;
    float radius = sqrt(form.x * form.x + blur * blur);
    float size = max(length(to - from), 1e-6);
    vec2 along = (to - from) / size;
    vec2 across = vec2(-along.y, along.x);
    // Two radii beyond either end and to either side.
    float way = mix(-2.0 * radius, size + 2.0 * radius, corner.x);
    local = vec2(way / size, corner.y * 2.0);
    measures = vec2(size / radius, form.y);
    body = matter * (form.x / radius);
    gl_Position = seen_at(from + along * way + across * (corner.y * 2.0 * radius));
}
#else
void main() {
    float along = clamp(local.x, 0.0, 1.0);
    float apart = length(vec2((local.x - along) * measures.x, local.y));
    float peak = measures.y;
    float share = along < peak ? along / peak : (1.0 - along) / (1.0 - peak);
    put(body * (bell(apart) * share));
}
#endif
