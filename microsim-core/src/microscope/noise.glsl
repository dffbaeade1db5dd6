// Noise from a table of random bytes; see noise.rs.

uniform sampler2D noise_table;

vec4 entry(vec2 at) {
    return texture2D(noise_table, (mod(at, TABLE) + 0.5) / TABLE);
}

float value(vec2 at, vec2 shift) {
    vec2 cell = floor(at);
    vec2 f = at - cell;
    vec2 t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    // The texture unit interpolates between the four corners.
    return texture2D(noise_table, (mod(cell + shift, TABLE) + t + 0.5) / TABLE).r * 2.0 - 1.0;
}

vec2 next_octave(vec2 at) {
    return vec2(1.6 * at.x - 1.2 * at.y, 1.2 * at.x + 1.6 * at.y);
}

float two_octaves(vec2 at, vec2 shift) {
    return value(at, shift) + 0.5 * value(next_octave(at), shift + NEXT_OCTAVE);
}

float three_octaves(vec2 at, vec2 shift) {
    vec2 next = next_octave(at);
    return two_octaves(at, shift) + 0.25 * value(next_octave(next), shift + 2.0 * NEXT_OCTAVE);
}

// Nearly normal, mean 0 and standard deviation 1.
float grain(vec4 bytes) {
    return (bytes.r + bytes.g + bytes.b + bytes.a - 2.0) * 1.732;
}

// Three uncorrelated numbers of mean 0 and of standard deviation 1 at entries.
vec3 three_grains(vec4 bytes) {
    vec4 b = bytes * 1.732;
    return vec3(b.r + b.g - b.b - b.a, b.r - b.g + b.b - b.a, b.r - b.g - b.b + b.a);
}
