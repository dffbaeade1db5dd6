// Walls and obstacles of a clear polymer; see chamber.rs.

#ifndef VERTEX
uniform vec4 room;

vec4 polymer(vec2 place, float depth) {
    if (depth <= -REACH) {
        return vec4(0.0);
    }
    float along = two_octaves(place / ALONG, room.zw);
    depth -= ROUGH * (0.5 + 0.5 * three_octaves(place / ROUGH_SIZE, room.zw));
    float ring = 1.0 + cos(CHIRP * (1.0 + SPREAD * along) * depth * depth);
    float fringes = FRINGES * max(1.0 - along, 0.0) * bell(1.6 * depth / REACH) * ring;
    float rise = rising(0.0, RIM * max(1.0 + LEANING * along, 0.2), depth);
    float texture = 1.0 + TEXTURE * three_octaves(place / TEXTURE_SIZE, room.zw);
    return POLYMER * (rise * texture + fringes);
}

void main() {
#ifdef OBSTACLE
    put(polymer(at, depth_at(at)));
#else
    vec2 half_size = 0.5 * room.xy;
    vec2 beyond = abs(at - half_size) - half_size + CORNER;
    put(polymer(at, length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - CORNER));
#endif
}
#endif
