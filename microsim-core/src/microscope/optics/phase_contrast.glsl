vec3 shade() {
    vec2 wave = behind(matter_here());
    vec2 s = surround();
    vec2 image = (wave - s) - vec2(-s.y, s.x) * TRANSMISSION;
    float intensity = dot(image, image) / (TRANSMISSION * TRANSMISSION);
    return vec3(BACKGROUND * pow(intensity, GAMMA));
}
