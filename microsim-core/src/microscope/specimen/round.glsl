// Bodies that are described from their centre outwards; see round.rs. Each is a fan of triangles.

varying vec2 own;
varying float rho;
varying float fade;
varying vec4 body;
varying vec4 shape;
varying vec4 noise;
// Place in the hollow's frame, and the square of its radius.
varying vec3 in_hollow;
varying vec4 dry;

#ifdef VERTEX
attribute vec2 centre;
// From the centre to the edge, and the radius there; the centre itself has the body's mean radius.
attribute vec3 rim;
// The body's first direction; where its centre lies in the hollow's frame.
attribute vec4 facing;
attribute vec4 matter;
attribute vec4 profile;
attribute vec4 grains;
attribute vec4 dried;
// Place in the hollow's frame; square of the hollow's radius; width over which the edge fades.
attribute vec4 hollow;

void main() {
    float softness = max(0.6 * pixel.x, hollow.w);
    fade = softness / rim.z;
    float is_rim = step(1e-9, dot(rim.xy, rim.xy));
    rho = is_rim * (1.0 + fade);
    vec2 way = rim.xy * (1.0 + fade);
    own = vec2(way.x * facing.x + way.y * facing.y, way.y * facing.x - way.x * facing.y);
    body = matter;
    shape = profile;
    dry = dried;
    in_hollow = vec3(hollow.xy * is_rim * (1.0 + fade) - facing.zw, hollow.z);
    noise = grains;
    gl_Position = seen_at(centre + way);
}
#else
#ifdef PELLICLE
// Half the body's length and width; where its noise begins.
uniform vec4 frame;
// Furrows, their depth, depth of the groove.
uniform vec3 pellicle;

float relief(vec2 own) {
    float meridian = own.y / sqrt(max(1.0 - own.x * own.x, 0.02));
    float uneven = 0.8 * two_octaves(own * 3.0, frame.zw);
    float furrow = sin(TURN * 0.5 * pellicle.x * meridian + uneven);
    float along = rising(GROOVE_END.x, GROOVE_END.y, own.x) * rising(1.0, 0.8, own.x);
    float from_middle = own.y - GROOVE.x - GROOVE.y * own.x - GROOVE.z * own.x * own.x;
    float width = GROOVE_WIDTH * (0.5 + 0.5 * rising(0.0, 0.8, own.x));
    float groove = bell(from_middle / width) * along;
    float lip = bell((abs(from_middle / width) - 1.7) / 0.45) * along;
    return 1.0 - pellicle.y * (1.0 - furrow) - pellicle.z * (groove - 0.25 * lip);
}
#endif

// Thickness of a dried cell.
float dried_thickness(float rho) {
    float fourth = rho * rho * rho * rho;
    float inside = 1.0 - mix(fourth, fourth * fourth, dry.x);
    float edge = sqrt(inside);
    float apart = dot(in_hollow.xy, in_hollow.xy);
    float knob = dry.z < 0.0 ? exp(-KNOB * apart) : 0.0;
    float depth = abs(dry.z);
    float sunk = depth * (exp(-mix(apart, apart * apart, dry.w)) - knob);
    float from_rim = (rho - 0.80) / 0.24;
    float bulge = max(1.0 - from_rim * from_rim, 0.0);
    return mix(edge, inside, dry.y) * (1.0 - sunk) * (1.0 + 0.22 * depth * bulge * bulge);
}

// Thickness in the living and in the dried state.
vec2 thickness(float rho) {
    float inside = 1.0 - rho * rho;
    if (inside <= 0.0) {
        return vec2(0.0);
    }
    if (shape.x > 0.0) {
        return vec2(pow(inside, shape.x));
    }
    float square = mix(in_hollow.z * dot(in_hollow.xy, in_hollow.xy), rho * rho, 0.4 + 0.6 * rho * rho);
    float living = sqrt(inside) * (shape.y + shape.z * square - shape.w * square * square) / THICKEST;
    return vec2(living, dried_thickness(rho));
}

void main() {
    vec2 amount = thickness(rho / (1.0 + fade)) * rising(1.0 + fade, 1.0 - fade, rho);
    if (noise.x > 0.0) {
        float uneven = 1.5 * noise.x * two_octaves(own / noise.y, noise.zw) * max(1.0 - rho * rho, 0.0);
        amount *= 1.0 + vec2(1.0, DYED) * uneven;
    }
#ifdef PELLICLE
    amount *= relief(own / frame.xy);
#endif
    put(body * amount.xyyy);
}
#endif
