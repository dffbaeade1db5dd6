vec3 dyes(vec4 matter) {
    float eosin = max(matter.z, 0.0);
    float cytoplasm = eosin / (DRY.x + DRY.y * eosin);
    float red = max(matter.y, 0.0);
    float haemoglobin = red - PRESSED.y * max(red - PRESSED.x, 0.0);
    return HAEMOGLOBIN * haemoglobin + CYTOPLASM * cytoplasm + NUCLEUS * matter.w;
}

vec3 shade() {
    vec4 here = matter_here();
    vec4 blue = 0.5 * (matter_beside(BLUE_SHIFT + BLUE_BLUR) + matter_beside(BLUE_SHIFT - BLUE_BLUR));
    vec2 place = area.xy + uv * area.zw;
    vec2 along = vec2(PLASMA_WAY.x * place.x - PLASMA_WAY.y * place.y, PLASMA_WAY.y * place.x + PLASMA_WAY.x * place.y);
    float plasma = two_octaves(along / PLASMA_SIZE, PLASMA_SHIFT);
    float uneven = value(place / UNLEVEL.y, PLASMA_SHIFT);
    float bent = clamp(curvature(STEP), -20.0, 20.0) * (1.0 + UNLEVEL.x * uneven);
    vec3 density = vec3(dyes(here).xy, dyes(blue).z * (1.0 + UNLEVEL.z * uneven)) + PLASMA * plasma;
    density /= 1.0 + TONE * abs(density);
    vec3 lack = clamp(-vec3(here.yy, blue.y), 0.0, DEEPEST);
    return BACKGROUND * exp(-density) * (1.0 - DEFOCUS * bent) * (1.0 - lack * (DARK - BRIGHT * lack));
}
