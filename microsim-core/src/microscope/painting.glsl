// The seed's own way to draw; see painting.rs.

// Middle of what is seen, micrometres, and clip units per micrometre.
uniform vec4 view;
varying vec2 at;

#ifdef PAGE
#ifdef VERTEX
attribute vec2 corner;

void main() {
    at = view.xy + corner / view.zw;
    gl_Position = vec4(corner, 0.0, 1.0);
}
#else
uniform vec4 room;

void main() {
#ifdef OBSTACLE
    bool is_solid = depth_at(at) > 0.0;
    if (!is_solid) {
        discard;
    }
#else
    vec2 beyond = at - clamp(at, vec2(0.0), room.xy);
    bool is_solid = dot(beyond, beyond) > 0.0;
#endif
    vec3 page = PAGE_COLOUR * (1.0 + 0.03 * two_octaves(at / 9.0, room.zw));
    gl_FragColor = vec4(page * (is_solid ? 0.7 : 1.0) / LIGHT_RANGE, 1.0);
}
#endif
#else
varying vec4 body;
varying vec4 rim_colour;
varying vec3 grains;

#ifdef VERTEX
attribute vec2 place;
attribute vec2 texture_place;
attribute vec4 colour;
attribute vec4 rim;
attribute vec3 noise;

void main() {
    at = texture_place;
    body = colour;
    rim_colour = rim;
    grains = noise;
    gl_Position = vec4((place - view.xy) * view.zw, 0.0, 1.0);
}
#else
void main() {
    float rho = length(at);
    if (rim_colour.a < 0.0) {
        // A disc: opacity and softness.
        gl_FragColor = vec4(body.rgb / LIGHT_RANGE, body.a * rising(1.0, 1.0 - grains.x, rho));
    } else {
        vec3 mottled = body.rgb * (1.0 + grains.x * three_octaves(at * 4.0, grains.yz));
        float share = 0.25 * rho + 0.75 * rising(0.80, 0.97, rho);
        gl_FragColor = vec4(mix(mottled, rim_colour.rgb, share) / LIGHT_RANGE, 1.0);
    }
}
#endif
#endif
