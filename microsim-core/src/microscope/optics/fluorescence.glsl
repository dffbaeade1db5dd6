vec3 shade() {
    vec4 matter = max(matter_here(), 0.0);
    vec2 shines = matter.wz + HAZE * surround();
    vec3 light = DARK + NUCLEUS * shines.x + CYTOPLASM * shines.y;
    return 1.0 - exp(-SATURATION * light);
}
