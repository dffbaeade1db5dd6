vec3 shade() {
    vec2 wave = behind(matter_here());
    vec2 s = surround();
    vec2 image = (wave - s) - vec2(-s.y, s.x) * TRANSMISSION;
    float intensity = dot(image, image) / (TRANSMISSION * TRANSMISSION);
    float light = BACKGROUND * pow(LEAK + (1.0 - LEAK) * intensity, GAMMA);
    return vec3(light / (1.0 + SHOULDER * max(light - BACKGROUND, 0.0)));
}
