// A map of distances from an edge; see distance_field.rs.

uniform sampler2D map;
// Lower left corner, cells per micrometre, depth of a full texel.
uniform vec4 map_place;
// Columns and rows, depth of an empty texel.
uniform vec3 map_size;

float texel(vec2 cell) {
    vec4 bytes = texture2D(map, (clamp(cell, vec2(0.0), map_size.xy - 1.0) + 0.5) / map_size.xy);
    return (bytes.r * 255.0 * 256.0 + bytes.g * 255.0) / 65535.0;
}

vec3 spline(float t) {
    return vec3(0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t));
}

// By a quadratic B-spline.
float depth_at(vec2 place) {
    vec2 at = (place - map_place.xy) * map_place.z;
    vec2 nearest = floor(at + 0.5);
    vec3 x = spline(at.x - nearest.x);
    vec3 y = spline(at.y - nearest.y);
    float sum = 0.0;
    for (int j = 0; j < 3; j++) {
        vec2 middle = nearest + vec2(0.0, float(j) - 1.0);
        vec3 row = vec3(texel(middle - vec2(1.0, 0.0)), texel(middle), texel(middle + vec2(1.0, 0.0)));
        float weight = j == 0 ? y.x : (j == 1 ? y.y : y.z);
        sum += weight * dot(x, row);
    }
    return map_size.z + (map_place.w - map_size.z) * sum;
}
