/* Chipmunk 7: ten iterations (its default), never sleeping. The library is the system's, with assertions as it may be. */
#include "peer.h"

#include <chipmunk/chipmunk.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct {
    cpSpace *space;
    cpBody **bodies;
    cpShape **shapes;
    cpConstraint **constraints;
    size_t first_pusher, body_count, shape_count, constraint_count;
    float dt;
} World;

static cpShape *add_shape(World *world, cpShape *shape, double friction) {
    cpShapeSetFriction(shape, friction);
    return world->shapes[world->shape_count++] = cpSpaceAddShape(world->space, shape);
}

static void add_constraint(World *world, cpConstraint *constraint) {
    world->constraints[world->constraint_count++] = cpSpaceAddConstraint(world->space, constraint);
}

static void add_walls(World *world, PeerVec size, double friction) {
    cpVect c[4] = {cpv(0, 0), cpv(size.x, 0), cpv(size.x, size.y), cpv(0, size.y)};
    for (int k = 0; k < 4; k++) {
        cpBody *ground = cpSpaceGetStaticBody(world->space);
        add_shape(world, cpSegmentShapeNew(ground, c[k], c[(k + 1) % 4], 0), friction);
    }
}

static cpBody *add_disc(World *world, const PeerDisc *disc, double friction) {
    cpBody *body = cpSpaceAddBody(world->space, cpBodyNew(disc->mass, INFINITY));
    cpBodySetPosition(body, cpv(disc->position.x, disc->position.y));
    if (disc->part != PEER_NUCLEUS) {
        cpShape *shape = add_shape(world, cpCircleShapeNew(body, disc->radius, cpvzero), friction);
        cpGroup group = disc->part == PEER_SATELLITE ? disc->owner + 1 : CP_NO_GROUP;
        cpShapeSetFilter(shape, cpShapeFilterNew(group, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
    }
    return body;
}

static void add_link(World *world, const PeerLink *link, const PeerField *field) {
    const PeerDisc *da = &field->discs[link->a], *db = &field->discs[link->b];
    cpBody *a = world->bodies[link->a], *b = world->bodies[link->b];
    cpBody *ground = cpSpaceGetStaticBody(world->space);
    cpVect home = cpv(da->position.x, da->position.y);
    double reduced_mass = 1 / (1 / da->mass + 1 / db->mass);
    switch (link->kind) {
    case PEER_ROD:
        add_constraint(world, cpPinJointNew(a, b, cpvzero, cpvzero));
        break;
    case PEER_PIN:
        add_constraint(world, cpPivotJointNew2(a, b, cpvzero, cpvzero));
        break;
    case PEER_SPRING: {
        double damping = 2 * field->damping_ratio * sqrt(link->stiffness * reduced_mass);
        add_constraint(world, cpDampedSpringNew(a, b, cpvzero, cpvzero, link->length, link->stiffness, damping));
        break;
    }
    case PEER_ANCHOR:
        add_constraint(world, cpDampedSpringNew(a, ground, cpvzero, home, 0, link->stiffness, 0));
        add_constraint(world, cpSlideJointNew(a, ground, cpvzero, home, 0, link->max_length));
        break;
    }
}

/* A library with assertions greets on stdout, which is for data: it is sent to stderr. */
static cpSpace *new_space(void) {
    fflush(stdout);
    int out = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    cpSpace *space = cpSpaceNew();
    fflush(stdout);
    dup2(out, STDOUT_FILENO);
    close(out);
    return space;
}

static void *create_field(const PeerField *field) {
    World *world = calloc(1, sizeof *world);
    world->space = new_space();
    world->dt = field->dt;
    world->body_count = field->disc_count;
    world->first_pusher = field->disc_count - field->pusher_count;
    world->bodies = calloc(field->disc_count, sizeof *world->bodies);
    world->shapes = calloc(field->disc_count + 4, sizeof *world->shapes);
    world->constraints = calloc(2 * field->link_count, sizeof *world->constraints);
    cpSpaceSetDamping(world->space, exp(-field->damping));
    /* Chipmunk multiplies the coefficients of the two. */
    double friction = sqrt(field->friction);
    add_walls(world, field->size, friction);
    for (size_t k = 0; k < field->disc_count; k++) {
        world->bodies[k] = add_disc(world, &field->discs[k], friction);
    }
    for (size_t k = 0; k < field->link_count; k++) {
        add_link(world, &field->links[k], field);
    }
    return world;
}

static void step(void *handle, const PeerVec *forces) {
    World *world = handle;
    for (size_t k = world->first_pusher; k < world->body_count; k++) {
        PeerVec force = forces[k - world->first_pusher];
        cpBodySetForce(world->bodies[k], cpv(force.x, force.y));
    }
    cpSpaceStep(world->space, world->dt);
}

static PeerMotion motion(void *handle, size_t index) {
    World *world = handle;
    cpVect p = cpBodyGetPosition(world->bodies[index]), v = cpBodyGetVelocity(world->bodies[index]);
    return (PeerMotion){{p.x, p.y}, {v.x, v.y}};
}

static void destroy(void *handle) {
    World *world = handle;
    for (size_t k = 0; k < world->constraint_count; k++) {
        cpSpaceRemoveConstraint(world->space, world->constraints[k]);
        cpConstraintFree(world->constraints[k]);
    }
    for (size_t k = 0; k < world->shape_count; k++) {
        cpSpaceRemoveShape(world->space, world->shapes[k]);
        cpShapeFree(world->shapes[k]);
    }
    for (size_t k = 0; k < world->body_count; k++) {
        cpSpaceRemoveBody(world->space, world->bodies[k]);
        cpBodyFree(world->bodies[k]);
    }
    cpSpaceFree(world->space);
    free(world->constraints);
    free(world->shapes);
    free(world->bodies);
    free(world);
}

const PeerEngine CHIPMUNK = {create_field, NULL, step, motion, destroy, NULL, NULL};
