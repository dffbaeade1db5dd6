vec3 shade() {
    vec2 wave = behind(matter_here());
    vec2 detail = wave - surround();
    vec2 place = area.xy + uv * area.zw;
    float noise = value(place / FOCUS.z, FOCUS_SHIFT);
    float mottle = 1.0 + MOTTLE.x * two_octaves(place / MOTTLE.y, FOCUS_SHIFT);
    float focus = FOCUS.x * noise / (abs(noise) + FOCUS.y);
    float focused = clamp(1.0 - DEFOCUS * focus * curvature(STEP), 0.2, 2.0);
    wave += focus * vec2(-detail.y, detail.x);
    return vec3(BACKGROUND * mottle * pow(dot(wave, wave) * focused, 1.5));
}
