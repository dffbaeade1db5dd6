// A box on the slide: each pixel knows its place.

varying vec2 at;

#ifdef VERTEX
attribute vec2 place;

void main() {
    at = place;
    gl_Position = seen_at(place);
}
#endif
