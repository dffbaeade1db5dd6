vec3 shade() {
    vec4 matter = max(matter_here(), 0.0);
    vec3 light = DARK + HAZE * (1.0 - surround().x) + NUCLEUS * matter.w + CYTOPLASM * matter.z;
    return 1.0 - exp(-SATURATION * light);
}
