vec3 shade() {
    vec4 matter = max(matter_here(), 0.0);
    vec2 shines = matter.wz * vec2(mix(1.0, matter.w, CONDENSED), 1.0) + HAZE * surround();
    float dark = 1.0 + UNEVEN * two_octaves((area.xy + uv * area.zw) / UNEVEN_SIZE, UNEVEN_SHIFT);
    vec3 light = DARK * dark + NUCLEUS * shines.x + CYTOPLASM * shines.y;
    return 1.0 - exp(-SATURATION * light);
}
