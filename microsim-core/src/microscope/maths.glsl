// Small functions; see maths.rs.

// Like smoothstep, but it may also fall.
float rising(float low, float high, float x) {
    float t = clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

float bell(float x) {
    return exp(-x * x);
}
