vec3 shade() {
    float focused = clamp(1.0 - DEFOCUS * curvature(STEP), 0.2, 2.0);
    return vec3(BACKGROUND * transmitted(matter_here()) * focused);
}
