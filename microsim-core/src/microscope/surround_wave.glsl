// Three passes that make the surround wave; see surround_wave.rs.

varying vec2 uv;

#ifdef SPREAD
uniform sampler2D waves;
// One pixel to the side, and how many pixels it takes.
uniform vec3 side;
// Of the near and of the far distribution.
uniform vec2 weights[LONGEST];

// Both waves, each blurred by its own distribution.
vec4 spread() {
    vec4 sum = unkept(texture2D(waves, uv)) * weights[0].xxyy;
    for (int k = 1; k < LONGEST; k++) {
        if (float(k) > side.z) {
            break;
        }
        vec2 step = side.xy * float(k);
        sum += (unkept(texture2D(waves, uv + step)) + unkept(texture2D(waves, uv - step))) * weights[k].xxyy;
    }
    return sum;
}

void main() {
#ifdef LAST
    vec4 both = spread();
    vec2 fine = kept(vec4(mix(both.zw, both.xy, NEAR_SHARE), 0.0, 0.0)).xy * 255.0;
    // In two bytes each: a halo is smooth, and steps in it would show.
    gl_FragColor = vec4(floor(fine) / 255.0, fract(fine));
#else
    gl_FragColor = kept(spread());
#endif
}
#else
void main() {
#ifdef EMISSION
    vec2 wave = emitted(matter_at(uv));
#else
    vec2 wave = behind(matter_at(uv));
#endif
    gl_FragColor = kept(vec4(wave, wave));
}
#endif
