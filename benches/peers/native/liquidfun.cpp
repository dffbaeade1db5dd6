// LiquidFun 1.1 (Box2D 2.3): 8 velocity and 3 position iterations (its manual's), two particle iterations, sleeping and
// continuous collision off.
#include "Box2D/Box2D.h"
#include "peer.h"

#include <cmath>
#include <vector>

namespace {

const int32 VELOCITY_ITERATIONS = 8, POSITION_ITERATIONS = 3, PARTICLE_ITERATIONS = 2;

struct World {
    b2World world;
    float dt;
    std::vector<b2Body *> bodies;
    size_t first_pusher = 0;
    b2ParticleSystem *fluid = nullptr;

    World(float gravity, float dt) : world(b2Vec2(0, -gravity)), dt(dt) {
        world.SetAllowSleeping(false);
        world.SetContinuousPhysics(false);
    }
};

b2Vec2 vec(PeerVec v) { return b2Vec2(v.x, v.y); }

b2Body *add_walls(b2World &world, PeerVec size, float friction) {
    b2BodyDef def;
    b2Body *ground = world.CreateBody(&def);
    b2Vec2 corners[] = {b2Vec2(0, 0), b2Vec2(size.x, 0), b2Vec2(size.x, size.y), b2Vec2(0, size.y)};
    b2ChainShape walls;
    walls.CreateLoop(corners, 4);
    ground->CreateFixture(&walls, 0)->SetFriction(friction);
    return ground;
}

b2Body *add_disc(b2World &world, const PeerDisc &disc, const PeerField &field) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = vec(disc.position);
    def.linearDamping = field.damping;
    def.fixedRotation = true;
    b2Body *body = world.CreateBody(&def);
    if (disc.part != PEER_NUCLEUS) {
        b2CircleShape circle;
        circle.m_radius = disc.radius;
        b2FixtureDef fixture;
        fixture.shape = &circle;
        fixture.friction = field.friction;
        fixture.filter.groupIndex = disc.part == PEER_SATELLITE ? -1 - int(disc.owner) : 0;
        body->CreateFixture(&fixture);
    }
    b2MassData mass = {disc.mass, b2Vec2(0, 0), 0};
    body->SetMassData(&mass);
    return body;
}

// Springs are tuned by frequency: of the two bodies' reduced mass on the spring.
float hertz(float stiffness, float inverse_mass) { return std::sqrt(stiffness * inverse_mass) / (2 * b2_pi); }

void add_anchor(World &w, b2Body *ground, const PeerLink &link, const PeerDisc &disc) {
    b2MouseJointDef spring; // the only spring of Box2D 2.3 that may have length 0
    spring.bodyA = ground;
    spring.bodyB = w.bodies[link.a];
    spring.target = vec(disc.position);
    spring.maxForce = 1e9f;
    spring.frequencyHz = hertz(link.stiffness, 1 / disc.mass);
    spring.dampingRatio = 0;
    w.world.CreateJoint(&spring);
    b2RopeJointDef rope;
    rope.bodyA = ground;
    rope.bodyB = w.bodies[link.a];
    rope.localAnchorA = vec(disc.position);
    rope.localAnchorB.SetZero();
    rope.maxLength = link.max_length;
    w.world.CreateJoint(&rope);
}

void add_link(World &w, b2Body *ground, const PeerLink &link, const PeerField &field) {
    const PeerDisc &a = field.discs[link.a], &b = field.discs[link.b];
    if (link.kind == PEER_ANCHOR) {
        add_anchor(w, ground, link, a);
    } else if (link.kind == PEER_PIN) {
        b2RevoluteJointDef def;
        def.bodyA = w.bodies[link.a];
        def.bodyB = w.bodies[link.b];
        w.world.CreateJoint(&def);
    } else {
        b2DistanceJointDef def;
        def.bodyA = w.bodies[link.a];
        def.bodyB = w.bodies[link.b];
        def.length = link.length;
        if (link.kind == PEER_SPRING) {
            def.frequencyHz = hertz(link.stiffness, 1 / a.mass + 1 / b.mass);
            def.dampingRatio = field.damping_ratio;
        }
        w.world.CreateJoint(&def);
    }
}

void *create_field(const PeerField *field) {
    World *w = new World(0, field->dt);
    b2Body *ground = add_walls(w->world, field->size, field->friction);
    for (size_t k = 0; k < field->disc_count; k++) {
        w->bodies.push_back(add_disc(w->world, field->discs[k], *field));
    }
    w->first_pusher = field->disc_count - field->pusher_count;
    for (size_t k = 0; k < field->link_count; k++) {
        add_link(*w, ground, field->links[k], *field);
    }
    return w;
}

// A particle of this diameter is at rest on a hexagonal lattice of unit spacing: six contacts of weight 1 - 1 / d
// add up to the weight at which its pressure begins, 1.
const float REST_DIAMETER = 1.2f;

void *create_block(const PeerBlock *block) {
    World *w = new World(block->gravity, block->dt);
    add_walls(w->world, block->size, 0);
    b2ParticleSystemDef def;
    def.radius = 0.5f * REST_DIAMETER * block->spacing;
    w->fluid = w->world.CreateParticleSystem(&def);
    for (size_t k = 0; k < block->point_count; k++) {
        b2ParticleDef particle;
        particle.position = vec(block->points[k]);
        w->fluid->CreateParticle(particle);
    }
    return w;
}

void step(void *handle, const PeerVec *forces) {
    World &w = *static_cast<World *>(handle);
    for (size_t k = w.first_pusher; k < w.bodies.size(); k++) {
        w.bodies[k]->ApplyForceToCenter(vec(forces[k - w.first_pusher]), true);
    }
    w.world.Step(w.dt, VELOCITY_ITERATIONS, POSITION_ITERATIONS, PARTICLE_ITERATIONS);
}

PeerMotion motion(void *handle, size_t index) {
    World &w = *static_cast<World *>(handle);
    b2Vec2 p = w.fluid ? w.fluid->GetPositionBuffer()[index] : w.bodies[index]->GetPosition();
    b2Vec2 v = w.fluid ? w.fluid->GetVelocityBuffer()[index] : w.bodies[index]->GetLinearVelocity();
    return {{p.x, p.y}, {v.x, v.y}};
}

void destroy(void *handle) { delete static_cast<World *>(handle); }

} // namespace

extern "C" {
extern const PeerEngine LIQUIDFUN;
const PeerEngine LIQUIDFUN = {create_field, create_block, step, motion, destroy};
}
