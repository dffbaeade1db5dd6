vec3 shade() {
    vec4 matter = max(matter_here(), 0.0);
    float square = matter.w * matter.w;
    vec2 shines = vec2((1.0 + CONDENSED) * square / (CONDENSED + square), matter.z) + HAZE * surround();
    float dark = 1.0 + UNEVEN * two_octaves((area.xy + uv * area.zw) / UNEVEN_SIZE, UNEVEN_SHIFT);
    vec3 light = DARK * dark + NUCLEUS * shines.x + CYTOPLASM * shines.y;
    return 1.0 - exp(-SATURATION * light);
}
