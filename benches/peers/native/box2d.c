/* Box2D 3.2: four substeps (its default), one thread, sleeping and continuous collision off. */
#include "box2d/box2d.h"
#include "peer.h"

#include <math.h>
#include <stdlib.h>

enum { SUBSTEPS = 4 };

typedef struct {
    b2WorldId id;
    b2BodyId *bodies;
    size_t first_pusher, body_count;
    float dt;
} World;

static void add_walls(b2BodyId ground, PeerVec size, float friction) {
    b2ShapeDef def = b2DefaultShapeDef();
    def.material.friction = friction;
    b2Vec2 c[4] = {{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
    for (int k = 0; k < 4; k++) {
        b2Segment wall = {c[k], c[(k + 1) % 4]};
        b2CreateSegmentShape(ground, &def, &wall);
    }
}

static b2BodyId add_disc(b2WorldId world, const PeerDisc *disc, const PeerField *field) {
    b2BodyDef body = b2DefaultBodyDef();
    body.type = b2_dynamicBody;
    body.position = (b2Vec2){disc->position.x, disc->position.y};
    body.linearDamping = field->damping;
    body.motionLocks.angularZ = true;
    body.enableSleep = false;
    b2BodyId id = b2CreateBody(world, &body);
    if (disc->part != PEER_NUCLEUS) {
        b2ShapeDef def = b2DefaultShapeDef();
        def.material.friction = field->friction;
        def.enableContactEvents = false;
        def.updateBodyMass = false;
        def.filter.groupIndex = disc->part == PEER_SATELLITE ? -1 - (int)disc->owner : 0;
        b2Circle circle = {{0, 0}, disc->radius};
        b2CreateCircleShape(id, &def, &circle);
    }
    b2Body_SetMassData(id, (b2MassData){.mass = disc->mass});
    return id;
}

/* Springs are tuned by frequency: of the two bodies' reduced mass on the spring. */
static void make_spring(b2DistanceJointDef *def, const PeerLink *link, float inverse_mass, float damping_ratio) {
    def->enableSpring = true;
    def->hertz = sqrtf(link->stiffness * inverse_mass) / (2 * B2_PI);
    def->dampingRatio = damping_ratio;
}

static void add_link(World *world, b2BodyId ground, const PeerLink *link, const PeerField *field) {
    const PeerDisc *a = &field->discs[link->a], *b = &field->discs[link->b];
    if (link->kind == PEER_PIN) {
        b2RevoluteJointDef def = b2DefaultRevoluteJointDef();
        def.base.bodyIdA = world->bodies[link->a];
        def.base.bodyIdB = world->bodies[link->b];
        b2CreateRevoluteJoint(world->id, &def);
        return;
    }
    b2DistanceJointDef def = b2DefaultDistanceJointDef();
    def.base.bodyIdA = world->bodies[link->a];
    def.base.bodyIdB = world->bodies[link->b];
    def.length = link->length;
    if (link->kind == PEER_SPRING) {
        make_spring(&def, link, 1 / a->mass + 1 / b->mass, field->damping_ratio);
    } else if (link->kind == PEER_ANCHOR) {
        def.base.bodyIdB = ground;
        def.base.localFrameB.p = (b2Vec2){a->position.x, a->position.y};
        make_spring(&def, link, 1 / a->mass, 0);
        def.enableLimit = true;
        def.minLength = 0;
        def.maxLength = link->max_length;
    }
    b2CreateDistanceJoint(world->id, &def);
}

static void *create_field(const PeerField *field) {
    b2WorldDef def = b2DefaultWorldDef();
    def.gravity = (b2Vec2){0, 0};
    def.enableSleep = false;
    def.enableContinuous = false;
    World *world = calloc(1, sizeof *world);
    world->id = b2CreateWorld(&def);
    world->dt = field->dt;
    world->body_count = field->disc_count;
    world->first_pusher = field->disc_count - field->pusher_count;
    world->bodies = calloc(field->disc_count, sizeof *world->bodies);
    b2BodyDef ground_def = b2DefaultBodyDef();
    b2BodyId ground = b2CreateBody(world->id, &ground_def);
    add_walls(ground, field->size, field->friction);
    for (size_t k = 0; k < field->disc_count; k++) {
        world->bodies[k] = add_disc(world->id, &field->discs[k], field);
    }
    for (size_t k = 0; k < field->link_count; k++) {
        add_link(world, ground, &field->links[k], field);
    }
    return world;
}

static void step(void *handle, const PeerVec *forces) {
    World *world = handle;
    for (size_t k = world->first_pusher; k < world->body_count; k++) {
        PeerVec force = forces[k - world->first_pusher];
        b2Body_ApplyForceToCenter(world->bodies[k], (b2Vec2){force.x, force.y}, true);
    }
    b2World_Step(world->id, world->dt, SUBSTEPS);
}

static PeerMotion motion(void *handle, size_t index) {
    World *world = handle;
    b2Pos p = b2Body_GetPosition(world->bodies[index]);
    b2Vec2 v = b2Body_GetLinearVelocity(world->bodies[index]);
    return (PeerMotion){{(float)p.x, (float)p.y}, {v.x, v.y}};
}

static void destroy(void *handle) {
    World *world = handle;
    b2DestroyWorld(world->id);
    free(world->bodies);
    free(world);
}

const PeerEngine BOX2D = {create_field, NULL, step, motion, destroy, NULL, NULL};
