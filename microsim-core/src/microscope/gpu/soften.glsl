// Blur of the image along its rows.

varying vec2 uv;
uniform sampler2D light;
// One pixel to the side, and how many pixels it takes.
uniform vec3 side;
uniform float weights[LONGEST];

void main() {
    vec4 sum = weights[0] * texture2D(light, uv);
    for (int k = 1; k < LONGEST; k++) {
        if (float(k) > side.z) {
            break;
        }
        vec2 step = side.xy * float(k);
        sum += weights[k] * (texture2D(light, uv + step) + texture2D(light, uv - step));
    }
    gl_FragColor = sum;
}
