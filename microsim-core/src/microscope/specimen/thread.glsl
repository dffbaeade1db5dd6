// Thin straight threads; see spot.rs.

// Along the thread in its lengths, and across it in its radii.
varying vec2 local;
varying vec2 measures;
varying vec4 body;

#ifdef VERTEX
attribute vec2 from;
attribute vec2 to;
attribute vec2 corner;
attribute float half_width;
attribute vec4 matter;

void main() {
    float blur = 0.7 * pixel.x;
    float radius = sqrt(half_width * half_width + blur * blur);
    float size = max(length(to - from), 1e-6);
    vec2 along = (to - from) / size;
    vec2 across = vec2(-along.y, along.x);
    // Two radii beyond either end and to either side.
    float way = mix(-2.0 * radius, size + 2.0 * radius, corner.x);
    local = vec2(way / size, corner.y * 2.0);
    measures = vec2(size / radius, 0.0);
    body = matter * (half_width / radius);
    gl_Position = seen_at(from + along * way + across * (corner.y * 2.0 * radius));
}
#else
void main() {
    float along = clamp(local.x, 0.0, 1.0);
    float apart = length(vec2((local.x - along) * measures.x, local.y));
    put(body * (bell(apart) * (1.0 - along * along)));
}
#endif
