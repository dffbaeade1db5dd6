vec3 shade() {
    vec4 matter = matter_here();
    float cytoplasm = matter.z / (DRY.x + DRY.y * abs(matter.z));
    float haemoglobin = matter.y * sqrt(abs(matter.y));
    float plasma = three_octaves((area.xy + uv * area.zw) / PLASMA_SIZE, PLASMA_SHIFT);
    float bent = clamp(curvature(STEP), -20.0, 20.0);
    vec3 dyes = HAEMOGLOBIN * haemoglobin + CYTOPLASM * cytoplasm + NUCLEUS * matter.w;
    return BACKGROUND * exp(-dyes - PLASMA * plasma) * (1.0 - DEFOCUS * bent);
}
