// Uneven glass; see background.rs.

varying vec2 at;

#ifdef VERTEX
attribute vec2 corner;

void main() {
    at = view.xy + corner / view.zw;
    gl_Position = vec4(corner, 0.0, 1.0);
}
#else
uniform vec4 bias;
uniform vec4 shifts;

void main() {
    float fine = FINE * rising(1.2, 0.3, pixel.x) * three_octaves(at / FINE_SIZE, shifts.zw);
    float coarse = COARSE * rising(15.0, 4.0, pixel.x) * three_octaves(at / COARSE_SIZE, shifts.xy);
    vec4 dither = entry(floor(gl_FragCoord.xy)) - 0.5;
    gl_FragColor = vec4(fine + coarse, 0.0, 0.0, 0.0) * scale + bias + pixel.y * dither;
}
#endif
