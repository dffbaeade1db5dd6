// Walls and obstacles of a clear polymer; see chamber.rs.

#ifndef VERTEX
uniform vec4 room;

vec4 polymer(vec2 place, float depth) {
    if (depth <= 0.0) {
        return vec4(0.0);
    }
    float lacking = 0.5 + 0.5 * three_octaves(place / ROUGH_SIZE, room.zw);
    depth = max(depth - ROUGH * lacking, 0.0);
    float rim = max(1.0 - depth / RIM, 0.0);
    float texture = 1.0 + TEXTURE * three_octaves(place / TEXTURE_SIZE, room.zw);
    return POLYMER * (sqrt(1.0 - rim * rim) * rising(0.0, EDGE, depth) * texture);
}

void main() {
#ifdef OBSTACLE
    put(polymer(at, depth_at(at)));
#else
    put(polymer(at, length(at - clamp(at, vec2(0.0), room.xy))));
#endif
}
#endif
