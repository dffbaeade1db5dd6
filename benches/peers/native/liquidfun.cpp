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
    // Of a cell of the crowd; 0 where there is none.
    size_t ring = 0, cytoplasm = 0;
    float max_speed = 0;

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

// A disc of a cell's membrane: a circle of mass 1.
b2Body *add_ring_disc(b2World &world, b2Vec2 at, const PeerCrowd &crowd) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = at;
    def.linearDamping = crowd.damping;
    def.fixedRotation = true;
    b2Body *body = world.CreateBody(&def);
    b2CircleShape circle;
    circle.m_radius = crowd.disc_radius;
    body->CreateFixture(&circle, 0)->SetFriction(crowd.friction);
    b2MassData mass = {1, b2Vec2(0, 0), 0};
    body->SetMassData(&mass);
    return body;
}

// The thesis' filled chain (3.1.2): circles on a ring, each joined to the next by a rigid distance joint, around water
// particles. Discs that are not neighbours collide, those of the same ring too.
void add_cell(World &w, b2Vec2 centre, const PeerCrowd &crowd) {
    size_t first = w.bodies.size(), count = crowd.ring_count;
    for (size_t k = 0; k < count; k++) {
        w.bodies.push_back(add_ring_disc(w.world, centre + vec(crowd.ring[k]), crowd));
    }
    for (size_t k = 0; k < count; k++) {
        b2Body *a = w.bodies[first + k], *b = w.bodies[first + (k + 1) % count];
        b2DistanceJointDef def;
        def.Initialize(a, b, a->GetPosition(), b->GetPosition());
        w.world.CreateJoint(&def);
    }
    for (size_t k = 0; k < crowd.cytoplasm_count; k++) {
        b2ParticleDef particle;
        particle.position = centre + vec(crowd.cytoplasm[k]);
        w.fluid->CreateParticle(particle);
    }
}

void *create_crowd(const PeerCrowd *crowd) {
    World *w = new World(0, crowd->dt);
    add_walls(w->world, crowd->size, crowd->friction);
    b2ParticleSystemDef def;
    def.radius = 0.5f * REST_DIAMETER * crowd->spacing;
    float stride = b2_particleStride * 2 * def.radius; // a particle's mass is the density times its square
    def.density = 1 / (stride * stride);
    w->fluid = w->world.CreateParticleSystem(&def);
    w->ring = crowd->ring_count;
    w->cytoplasm = crowd->cytoplasm_count;
    w->max_speed = crowd->max_speed;
    for (size_t k = 0; k < crowd->cell_count; k++) {
        add_cell(*w, vec(crowd->centres[k]), *crowd);
    }
    w->first_pusher = w->bodies.size();
    return w;
}

// Place of a disc of the crowd in `bodies`, of a particle among the particles after them.
size_t crowd_index(const World &w, size_t index) {
    size_t cell = index / (w.ring + w.cytoplasm), k = index % (w.ring + w.cytoplasm);
    return k < w.ring ? cell * w.ring + k : w.bodies.size() + cell * w.cytoplasm + (k - w.ring);
}

void drive(void *handle, size_t index, PeerVec velocity) {
    World &w = *static_cast<World *>(handle);
    w.bodies[crowd_index(w, index)]->SetLinearVelocity(vec(velocity));
}

// The thesis' bound on the speed of a chain's bodies (3.1.2).
void limit_speeds(World &w) {
    for (b2Body *body : w.bodies) {
        b2Vec2 v = body->GetLinearVelocity();
        float speed = v.Length();
        if (speed > w.max_speed) {
            body->SetLinearVelocity((w.max_speed / speed) * v);
        }
    }
}

void step(void *handle, const PeerVec *forces) {
    World &w = *static_cast<World *>(handle);
    for (size_t k = w.first_pusher; k < w.bodies.size(); k++) {
        w.bodies[k]->ApplyForceToCenter(vec(forces[k - w.first_pusher]), true);
    }
    if (w.ring) {
        limit_speeds(w);
    }
    w.world.Step(w.dt, VELOCITY_ITERATIONS, POSITION_ITERATIONS, PARTICLE_ITERATIONS);
}

PeerMotion motion(void *handle, size_t index) {
    World &w = *static_cast<World *>(handle);
    size_t k = w.ring ? crowd_index(w, index) : index;
    bool is_particle = k >= w.bodies.size();
    k -= is_particle ? w.bodies.size() : 0;
    b2Vec2 p = is_particle ? w.fluid->GetPositionBuffer()[k] : w.bodies[k]->GetPosition();
    b2Vec2 v = is_particle ? w.fluid->GetVelocityBuffer()[k] : w.bodies[k]->GetLinearVelocity();
    return {{p.x, p.y}, {v.x, v.y}};
}

void destroy(void *handle) { delete static_cast<World *>(handle); }

} // namespace

extern "C" {
extern const PeerEngine LIQUIDFUN;
const PeerEngine LIQUIDFUN = {create_field, create_block, step, motion, destroy, create_crowd, drive};
}
