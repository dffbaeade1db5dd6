/* What an engine that is not Rust offers to `src/engines/native.rs`, which mirrors these declarations. */
#ifndef MICROSIM_PEER_H
#define MICROSIM_PEER_H

#include <stddef.h>
#include <stdint.h>

typedef struct { float x, y; } PeerVec;
typedef struct { PeerVec position, velocity; } PeerMotion;

/* What a disc of the platelet field is. Nuclei collide with nothing, satellites not with those of their own ring. */
enum { PEER_NUCLEUS, PEER_INTERLAYER, PEER_SATELLITE, PEER_PUSHER };

typedef struct {
    PeerVec position;
    float mass, radius;
    uint32_t part, owner; /* owner: number of its platelet */
} PeerDisc;

/* ROD: rigid. SPRING: towards its length. PIN: concentric. ANCHOR: spring of disc `a` to where it starts, and a rope. */
enum { PEER_ROD, PEER_SPRING, PEER_PIN, PEER_ANCHOR };

typedef struct {
    uint32_t kind, a, b;
    float length, stiffness, max_length;
} PeerLink;

typedef struct {
    const PeerDisc *discs;
    size_t disc_count;
    const PeerLink *links;
    size_t link_count;
    size_t pusher_count; /* the last discs */
    PeerVec size;        /* of the walled room, its lower left corner at the origin */
    float dt, friction, damping, damping_ratio;
} PeerField;

typedef struct {
    const PeerVec *points;
    size_t point_count;
    PeerVec size;
    float dt, spacing, gravity;
} PeerBlock;

typedef struct {
    const PeerVec *centres; /* of the cells */
    size_t cell_count;
    const PeerVec *ring; /* discs of mass 1, around a cell's centre; each is linked to the next, the last to the first */
    size_t ring_count;
    const PeerVec *cytoplasm; /* particles of mass 1, around a cell's centre */
    size_t cytoplasm_count;
    PeerVec size;
    float dt, disc_radius, spacing, friction, damping;
    float max_speed; /* of discs */
} PeerCrowd;

typedef struct {
    void *(*create_field)(const PeerField *);
    void *(*create_block)(const PeerBlock *);                /* or NULL */
    void (*step)(void *world, const PeerVec *pusher_forces); /* not read without pushers */
    PeerMotion (*motion)(void *world, size_t index);
    void (*destroy)(void *world);
    void *(*create_crowd)(const PeerCrowd *);                    /* or NULL */
    void (*drive)(void *world, size_t index, PeerVec velocity); /* sets a ring's disc's; NULL without crowds */
} PeerEngine;

#endif
