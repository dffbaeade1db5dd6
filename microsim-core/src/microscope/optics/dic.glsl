vec3 shade() {
    float difference = phase_beside(-SHEAR) - phase_beside(SHEAR);
    float ratio = sin(0.5 * (difference + BIAS)) / sin(0.5 * BIAS);
    return vec3(BACKGROUND * ratio * ratio);
}
