// Cells that crawl; see amoeboid.rs.

#ifndef VERTEX
// Centre, radius, width of the rim.
uniform vec4 middle;
// To the cell's own frame.
uniform vec4 own_frame;
// Direction of the front, its strength, length of the cell.
uniform vec4 front;
// Where the clear front begins and ends along that direction; its thickness; time.
uniform vec4 lamella;
// Delay of the ruffles, how far inside they are; strength and size of the texture.
uniform vec4 relief;
uniform vec4 matter;
uniform vec4 nucleus_matter;
// Strength and size of the texture; how far it is bent out of shape.
uniform vec3 nucleus_texture;
// Irregularity of the front's edge, and how far it is ahead of that by its pulse.
uniform vec2 edge;
uniform vec3 lobes[LOBES];
// Where the noise of texture, ruffles, clumps, border and nuclear outline begins.
uniform vec2 shifts[5];

float rise(float depth) {
    float d = clamp(depth, 0.0, 1.0);
    return pow(d * (2.0 - d), 0.75);
}

float lamella_at(vec2 place) {
    vec2 from_centre = place - middle.xy;
    float across = from_centre.x * front.y - from_centre.y * front.x;
    float uneven = 0.05 * front.w * two_octaves(from_centre / (0.25 * middle.z), shifts[3]);
    float along = dot(from_centre, front.xy) + 0.15 * across * across / middle.z + uneven;
    return front.z * rising(lamella.x, lamella.y, along);
}

// `from_centre` is turned with the cell by `turn`.
// How much a place belongs to the nucleus, and to its rim.
vec2 nucleus_at(vec2 place, mat2 turn, vec2 from_centre, float softness) {
    float neck = NECK * middle.z;
    vec2 bends = from_centre / (BENDS * middle.z);
    vec2 bend = vec2(value(bends, shifts[4]), value(bends, shifts[3]));
    vec2 bent = place + nucleus_texture.z * middle.z * (bend * turn);
    float depth = lobes[0].z - length(bent - lobes[0].xy);
    for (int k = 1; k < LOBES; k++) {
        float other = lobes[k].z - length(bent - lobes[k].xy);
        float share = clamp(0.5 + 0.5 * (depth - other) / neck, 0.0, 1.0);
        depth = mix(other, depth, share) + neck * share * (1.0 - share);
    }
    if (depth <= -2.0 * softness - 0.3) {
        return vec2(0.0);
    }
    float uneven = three_octaves(from_centre / (0.2 * middle.z), shifts[4]);
    depth += NUCLEUS_UNEVEN * middle.z * uneven;
    float width = max(softness, NUCLEUS_EDGE);
    float thickness = mix(NUCLEUS_THIN, 1.0, rise(depth / NUCLEUS_RIM));
    float envelope = ENVELOPE * max(1.0 + uneven, 0.0) * bell((depth - 0.2) / 0.25);
    float band = bell((depth - 0.3) / CONDENSED_WIDTH) * (1.0 + uneven);
    return vec2(rising(-width, width, depth) * (thickness + envelope), band);
}

void main() {
    float softness = max(0.7 * pixel.x, 0.08);
    float depth = depth_at(at);
    if (depth <= -softness - 2.0 * edge.x) {
        gl_FragColor = vec4(0.0);
        return;
    }
    float front_share = lamella_at(at);
    vec2 from_centre = at - middle.xy;
    vec2 own = own_frame.xy * from_centre.x + own_frame.zw * from_centre.y;
    float rags = three_octaves(own / (RAGS * middle.z) + lamella.w, shifts[1]);
    float share = 1.0 + RIM_UNEVEN * value(own / (RIM_SIZE * middle.z), shifts[3]);
    float ragged = mix(RAGS_BEHIND, 1.0, front_share) * (POINTS.x - POINTS.y * abs(rags));
    depth += edge.x * (share * ragged + front_share * edge.y);
    float rim = middle.w * share;
    float inside = max(1.0 - dot(own, own) / (middle.z * middle.z), 0.0);
    float high = mix(FLAT * (1.0 - EDGE_UNEVEN * (share - 1.0)), 1.0, inside * inside);
    float dome = mix(high * rise(depth / rim), lamella.z * rise(depth / (0.25 * rim)), front_share);
    float uneven = three_octaves(own / relief.w, shifts[0]);
    vec4 sum = matter * (dome * (1.0 + relief.z * uneven));
    sum.z *= 1.0 + DYED * uneven;
    float ruffle = bell((depth - relief.y) / 0.28) * front_share;
    sum.x += relief.x * ruffle * rising(-0.3, 0.7, two_octaves(own * 0.7 + lamella.w, shifts[1]));
    vec2 way = normalize(vec2(own_frame.x + own_frame.w, own_frame.y - own_frame.z));
    mat2 turn = mat2(way, -way.y, way.x);
    vec2 turned = turn * from_centre;
    vec2 nucleus = nucleus_at(at, turn, turned, softness);
    vec2 grain = turned / nucleus_texture.y;
    vec2 other = mat2(OTHER_LATTICE, -OTHER_LATTICE.y, OTHER_LATTICE.x) * grain;
    float clumped = abs(two_octaves(grain, shifts[2])) + PATCHES * two_octaves(other, shifts[4]) + CONDENSED * nucleus.y;
    vec2 fine = mat2(FINE_LATTICE, -FINE_LATTICE.y, FINE_LATTICE.x) * grain;
    float gaps = GAPS * rising(OPEN.x, OPEN.y, value(fine, shifts[0]));
    float dense = 1.60 * rising(CHROMATIN.x, CHROMATIN.y, clumped) - gaps;
    float clumps = CLUMPS * nucleus_texture.x * (dense - 0.95);
    sum += nucleus_matter * nucleus.x * (1.0 + clumps * vec4(CLUMPS_DELAY, 1.0, 1.0, 1.0));
    put(sum * rising(-softness, softness, depth));
}
#endif
