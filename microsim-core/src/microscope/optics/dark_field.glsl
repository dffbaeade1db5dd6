vec3 shade() {
    vec2 scattered = behind(matter_here()) - surround();
    return vec3(pow(LEAK + GAIN * dot(scattered, scattered), GAMMA));
}
