// Small round things; see spot.rs.

// From the middle, in radii.
varying vec2 from_middle;
varying vec4 body;
// Shape, softness of the edge, chirp of the rings.
varying vec3 form;

#ifdef VERTEX
attribute vec2 at;
attribute vec2 corner;
attribute vec3 size;
attribute vec4 matter;

void main() {
    float blur = 0.7 * pixel.x;
    float radius = sqrt(size.x * size.x + blur * blur);
    float reach = abs(size.y) > 1.5 ? 1.8 : 1.25;
    from_middle = corner * reach;
    body = matter * (size.x * size.x / (radius * radius));
    form = vec3(size.y, max(blur / radius, 0.08), size.z);
    gl_Position = seen_at(at + from_middle * radius);
}
#else
void main() {
    float rho = length(from_middle);
    float profile;
    if (form.z != 0.0) {
        profile = max(sign(form.x) * bell(DAMPING * rho) * cos(form.z * rho * rho - LAG), 0.0);
    } else if (form.x < 0.5) {
        float inside = max(1.0 - rho * rho / (1.25 * 1.25), 0.0);
        profile = inside * inside;
    } else if (form.x < 1.5) {
        float edge = 1.0 + form.y;
        profile = sqrt(max(1.0 - rho * rho / (edge * edge), 0.0)) * rising(edge, 1.0 - form.y, rho);
    } else {
        profile = bell((rho - 1.2) / 0.25);
    }
    put(body * profile);
}
#endif
