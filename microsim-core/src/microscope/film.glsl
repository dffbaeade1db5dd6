// What records the image; see film.rs. The image is blurred along its columns on the way.

uniform sampler2D light;
// Level, vignette, black, white.
uniform vec4 exposure;
// Strength of the grain, of blotches of colour, width and height of the picture.
uniform vec4 stock;
uniform vec2 parts[3];
// Light of a field without a specimen, its share that glare is, and the slide's light, each by colour.
uniform vec3 slide[3];
// By how much the light grows from the middle on.
uniform vec2 gradient;
// Shadows of dust: place, radius, depth.
uniform vec4 shadows[SHADOWS];
// From the picture's pixels to the image: scale, where its lower edge is; one pixel of the image upwards.
uniform vec4 image;
uniform float reach;
uniform float weights[LONGEST];

vec3 light_at(vec2 place) {
    vec3 sum = weights[0] * texture2D(light, place).rgb;
    for (int k = 1; k < LONGEST; k++) {
        if (float(k) > reach) {
            break;
        }
        vec2 step = vec2(0.0, image.w * float(k));
        sum += weights[k] * (texture2D(light, place + step).rgb + texture2D(light, place - step).rgb);
    }
    return sum * LIGHT_RANGE;
}

vec3 grain_at(vec3 seen) {
    // Pixels are counted from the upper left.
    vec2 pixel = vec2(gl_FragCoord.x - 0.5, stock.w - gl_FragCoord.y - 0.5);
    float fine = grain(entry(pixel + parts[0]));
    // In the middle between four entries the texture unit gives their mean.
    float coarse = 4.0 * grain(entry(pixel + parts[1] + 0.5));
    vec3 sum = vec3(FINE * fine + COARSE * coarse);
    if (stock.y > 0.0) {
        // The texture unit interpolates between entries.
        sum += stock.y * BLOTCHES * three_grains(entry(pixel / BLOTCH_SIZE + parts[2]));
    }
    return stock.x * sqrt(max(seen * (1.15 - seen), 0.01)) * sum;
}

// What dust leaves of the light, from upwards coordinates.
float shaded(vec2 from_middle) {
    vec2 place = vec2(from_middle.x, -from_middle.y);
    float light = 1.0 + dot(gradient, place);
    for (int k = 0; k < SHADOWS; k++) {
        vec2 apart = place - shadows[k].xy;
        float inside = max(1.0 - dot(apart, apart) / (shadows[k].z * shadows[k].z), 0.0);
        float ring = float(k) < GRAINS_OF_DUST ? RING * (1.0 - inside) : 1.0;
        light *= 1.0 - shadows[k].w * ring * inside * inside;
    }
    return light;
}

void main() {
    vec2 half_size = 0.5 * stock.zw;
    vec2 from_middle = (gl_FragCoord.xy - half_size) / max(length(half_size), 1.0);
    vec3 light = mix(light_at(gl_FragCoord.xy * image.xy + vec2(0.0, image.z)), slide[0], slide[1]);
    float falloff = 1.0 - exposure.y * dot(from_middle, from_middle);
    vec3 seen = light * slide[2] * (exposure.x * falloff * shaded(from_middle));
    vec3 recorded = seen;
    if (stock.x > 0.0) {
        recorded += grain_at(seen);
    }
    gl_FragColor = vec4(mix(exposure.zzz, exposure.www, recorded), 1.0);
}
