// Christmas: a modernist tree in a night room.
//
// A golden pyramid trunk under a glowing octahedral star, three tiers of mirror and glass spheres,
// a gift, small balls that circle the tree, fairy lights and, if wanted, snow. Three coloured lamps
// throw soft shadows that overlap on a planked floor. With more ornaments the spheres shrink and
// fill a cone; the hierarchy keeps their price near log n.
//
// Method   One path per pixel: closest hit, direct light, then one continuing ray (mirror, floor,
//          varnish); in glass the refracted path first, the reflected one later from a one-place
//          queue. Shadows are cones to `shadowSamples` sub-discs of a lamp: the share of a sub-disc
//          that one occluder hides has a closed form, several multiply; smooth with one cone, exact
//          in the limit of many. Ornaments lie in Hilbert order under an implicit heap of boxes,
//          walked without a stack: a trail of bits knows which second children are still to come.
//          Trunk and star are the triangles of convex solids, found by clipping the ray with their
//          half-spaces: neighbours share plane equations, so no edge can leak.
// Sources  Haines, Guenther, Akenine-Moeller, Ray Tracing Gems ch. 7 (2019), eq. 5: sphere. Ize,
//          JCGT 2(2) (2013): slab test. Laine, HPG (2010): trail. Skilling, AIP Conf. Proc. 707
//          (2004): Hilbert curve. Jarzynski and Olano, JCGT 9(3) (2020): pcg3d. Vogel, Math.
//          Biosci. 44 (1979): phyllotaxis. Born and Wolf, Principles of Optics, 1.5: Fresnel.
//          Amanatides, SIGGRAPH (1984): cone footprints.
// Units    1 unit = 1 m, y up, linear sRGB colour until the display curve; lamps: radiance x m^2.
// Passes   wood, places, ranks, tree: on change of a tweak at most. moving: every frame, tiny.
// Bounds   llvmpipe ends the loops of a pixel after 65,535 turns together. `none` takes kBatch
//          spheres a turn: with 4096 and one shadow cone at most 8 rays x 4 walks x 512 turns.
// Defaults From `glint study presets/christmas.toml`: the three accelerations draw the same bits,
//          none an eighth slower; 5 bounces are 1e-5 (RMSE) from 8; hard shadows are 0.003 from
//          soft ones, none 0.027, and one cone is 8e-4 from 16; mirrorBlur 0.8 is 0.006 from none.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Tree
uniform int   ornaments;       //@ 16 [16, 4096] log "spheres: 16 in three tiers, more on a cone"
uniform float glass;           //@ 0.25 [0, 1] "share of the ornaments that are clear glass"
uniform float accents;         //@ 0.0 [0, 1] "share of the mirrors that are red or gold"
uniform vec3  ornamentTint;    //@ #58cc84 "colour of the mirror spheres"
uniform int   fairyLights;     //@ 72 [0, 256] "lights on the string round the tree"
uniform float fairyGlow;       //@ 1.0 [0, 4] "brightness of the string"
uniform float starGlow;        //@ 1.0 [0, 4] "brightness of the star"
//@ group Room
uniform float floorGloss;      //@ 1.0 [0, 1] "varnish: 0 is bare wood"
uniform float nightSky;        //@ 1.0 [0, 4] "brightness of walls and stars"
uniform int   orbitingBalls;   //@ 7 [0, 12] "fill-lit balls that circle the tree"
uniform float animation;       //@ 1.0 [0, 8] "speed of everything that moves"
//@ group Snow
uniform float snow;            //@ 0.0 [0, 1] "how thick it falls"
uniform float snowSpeed;       //@ 0.5 [0, 3] unit=m/s "how fast it falls"
//@ group Light
uniform vec3  keyColour;       //@ #ffcb8f "lamp in front, on the left"
uniform vec3  roseColour;      //@ #ff4a64 "lamp behind on the right"
uniform vec3  coolColour;      //@ #4f8bff "lamp behind on the left"
uniform float lampPower;       //@ 1.0 [0, 4] "brightness of the three lamps"
uniform float fillLight;       //@ 1.0 [0, 4] "reaches the circling balls and nothing else"
uniform int   shadows;         //@ 2 {off, hard, soft} quality reference=2 "kind of shadow"
uniform float lampRadius;      //@ 0.2 [0, 1] unit=m "size of the lamps; larger is softer"
//@ group Camera
uniform float cameraDistance;  //@ 5.6 [4.2, 8.5] unit=m "from the tree's axis"
uniform float cameraAngle;     //@ 20 [-180, 180] unit=deg "round the tree"
uniform float cameraHeight;    //@ 1.0 [0.1, 6] unit=m "of the eye"
uniform float targetHeight;    //@ 1.75 [0, 4] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-2, 2] unit=m "of the point looked at, to the right"
uniform float focalLength;     //@ 28 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   acceleration; //@ 2 {none, boxes, hierarchy} quality reference=0 second=hierarchy "to ornaments"
uniform int   bounces;         //@ 5 [1, 8] quality reference=8 "rays along one path"
uniform float mirrorBlur;  //@ 0.8 [0.1, 100] log unit=rad quality reference=100 "beyond: a blur"
uniform int   shadowSamples;   //@ 1 [1, 16] log quality reference=16 "cones to each lamp"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D wood;            //@ pass mainWood size=512x1024 wrap=repeat filter=mipmap
uniform sampler2D ornamentPlaces;  //@ pass mainPlaces size=64x128 filter=nearest
uniform sampler2D ornamentRanks;   //@ pass mainRanks size=64x64 format=r32f filter=nearest
uniform sampler2D ornamentTree;    //@ pass mainTree size=64x256 filter=nearest
uniform sampler2D moving;          //@ pass mainMoving size=256x2 filter=nearest

// ---- Constants and numbers ----------------------------------------------------------------------
// Lengths are metres; y = 0 is the floor, the tree stands on it at the origin. A hit is told by a
// number: an ornament's own, or one from kFloor on.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kIorGlass = 1.52;              // crown glass, visible light
const float kIorVarnish = 1.62;            // hard lacquer
const float kLeastThroughput = 0.012;      // a path that carries less is over
const float kLeastLight = 0.02;            // who sees less of a lamp sees nothing: walks may stop
const vec3  kRoom = vec3(9.0, 10.0, 9.0);  // m, half width, height, half depth
const float kTrunkHeight = 3.6, kTrunkHalf = 0.30, kCoreHalf = 0.46;   // m, core: under a cone
const float kConeHeight = 2.85, kConeRadius = 1.12, kConeApex = 3.6;   // m, for many ornaments
const vec3  kStarCentre = vec3(0.0, 3.74, 0.0), kStarHalf = vec3(0.20, 0.27, 0.20);    // m
const vec3  kBodyCentre = vec3(1.75, 0.34, 0.75), kBodyHalf = vec3(0.42, 0.34, 0.42);  // m
const vec3  kLidCentre = vec3(1.75, 0.70, 0.75), kLidHalf = vec3(0.47, 0.09, 0.47);    // m
const float kGiftTurn = 0.35;              // rad
const vec3  kAim = vec3(0.15, 0.6, 0.3);   // m, where the lamps point
const float kSpotCore = 0.985, kSpotRim = 0.86;          // cosines: full light within, none without
const float kPlank = 0.16, kPlankLength = 2.6;           // m
const vec2  kWoodTile = vec2(0.64, 5.0), kWoodTexels = vec2(512.0, 1024.0);   // m; across, along
const float kFlakeCell = 0.34, kFlakeRows = 32.0;        // m, and cells before the fall repeats
const int   kBatch = 8;                    // spheres in one turn of the plain loop
const int   kRow = 64;                     // texels in a row of the ornament buffers
const float kBoxGrid = 0.001;              // m, the hierarchy's boxes are rounded outwards to it
const vec3  kBoxOrigin = vec3(2.048, 0.1, 2.048);        // m
const int   kLeastForTree = 32;            // ornaments
const int   kTreeSteps = 4096;             // cap for one walk, measured at under 600
const int   kFloor = 8000, kWall = 8001, kTrunk = 8002, kStar = 8003, kBody = 8004, kLid = 8005;
const int   kBall = 8010;                  // and on; ids below 4096 are ornaments

struct Hit { float t; vec4 face; int id; };   // face: dot(xyz, p) = w, for what is flat
struct Lamp { vec3 pos; vec3 power; };

uvec3 hash3(ivec3 q) {
    uvec3 v = uvec3(q) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}
vec3 random3(ivec3 q) { return vec3(hash3(q) >> 8u) / 16777216.0; }
// A texel of a buffer that `filter=nearest` reads, from its place and how many there are; half the
// price of texelFetch on llvmpipe.
vec4 fetch(sampler2D buffer, vec2 place, vec2 texels) {
    return textureLod(buffer, (place + 0.5) / texels, 0.0);
}

// Cycles since the start, modulo 1, of a motion; its frequency is cut to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }

vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 linearColour(vec3 c) {   // from sRGB, a fit to 1/500
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

// A start for a secondary ray: some 8 ulp along the normal from a point that lies on the surface.
vec3 liftOff(vec3 p, vec3 nor) { return p + nor * (1e-6 * max(maxComponent(abs(p)), 0.1)); }

// Reflected share of unpolarised light, exact; eta: index beyond over index before the surface.
float fresnel(float cosI, float eta) {
    float gg = (eta - 1.0) * (eta + 1.0) + cosI * cosI;
    if (gg <= 0.0) return 1.0;
    float g = sqrt(gg);
    float a = (g - cosI) / max(g + cosI, 1e-9);
    float b = (cosI * (g + cosI) - 1.0) / (cosI * (g - cosI) + 1.0);
    return min(0.5 * a * a * (1.0 + b * b), 1.0);
}

// ---- Geometry -----------------------------------------------------------------------------------
// A convex solid is where all its half-spaces dot(n, p) <= d overlap, so a ray shares one span
// [enter, leave] with it: each half-space cuts the span at t = (d - n.ro) / (n.rd), in front if the
// ray runs into it, behind if it runs out. An edge is where two cuts change places in a maximum: no
// ray finds a gap between two faces, as there is none between numbers. So no edge can leak.

float intersectSphere(vec3 ro, vec3 rd, vec3 c, float r) {          // |rd| = 1
    vec3 f = ro - c;
    float b = dot(f, rd);
    vec3 l = f - b * rd;
    float d = r * r - dot(l, l);
    if (d < 0.0) return -1.0;
    float s = sqrt(d);
    return -b - s > 0.0 ? -b - s : -b + s;
}

vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}
// Does the ray meet the box before tMax? Far side widened by 2 ulp: rounding never loses a hit.
bool meetsBox(vec3 ro, vec3 inv, vec3 lo, vec3 hi, float tMax) {
    vec3 a = (lo - ro) * inv, b = (hi - ro) * inv;
    vec3 n = min(a, b), f = max(a, b);
    return max(max(n.x, n.y), max(n.z, 0.0)) <= min(min(f.x, f.y), min(f.z, tMax)) * 1.00000024;
}
// Clips a ray against dot(nor, p) <= d, moved out by widen * t: 0 for a ray, else a cone's slope.
void clipPlane(vec3 ro, vec3 rd, vec3 nor, float d, float widen,
               inout vec2 span, inout vec4 entry) {
    float speed = dot(nor, rd) - widen;
    if (abs(speed) < 1e-20) speed = 1e-20;
    float t = (d - dot(nor, ro)) / speed;
    if (speed > 0.0) span.y = min(span.y, t);
    else if (t > span.x) {
        span.x = t;
        entry = vec4(nor, d);
    }
}
void clipPair(vec3 ro, vec3 rd, vec3 nor, float d, float widen,
              inout vec2 span, inout vec4 entry) {
    clipPlane(ro, rd, nor, d, widen, span, entry);
    clipPlane(ro, rd, -nor, d, widen, span, entry);
}
// Solids: where a ray enters and leaves, entry after exit for a miss, and the face it enters by.
vec2 clipBox(vec3 ro, vec3 rd, vec3 halfSize, float widen, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    clipPair(ro, rd, vec3(1, 0, 0), halfSize.x, widen, span, entry);
    clipPair(ro, rd, vec3(0, 1, 0), halfSize.y, widen, span, entry);
    clipPair(ro, rd, vec3(0, 0, 1), halfSize.z, widen, span, entry);
    return span;
}
vec2 clipTrunk(vec3 ro, vec3 rd, float widen, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    float wide = ornaments <= 16 ? kTrunkHalf : kCoreHalf;
    vec3 n = vec3(kTrunkHeight, wide, kTrunkHeight * wide) / length(vec2(kTrunkHeight, wide));
    clipPlane(ro, rd, vec3(n.xy, 0.0), n.z, widen, span, entry);
    clipPlane(ro, rd, vec3(-n.x, n.y, 0.0), n.z, widen, span, entry);
    clipPlane(ro, rd, vec3(0.0, n.yx), n.z, widen, span, entry);
    clipPlane(ro, rd, vec3(0.0, n.y, -n.x), n.z, widen, span, entry);
    return span;
}
vec2 clipStar(vec3 ro, vec3 rd, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    float d = 1.0 / length(1.0 / kStarHalf);
    vec3 n = d / kStarHalf;
    clipPair(ro, rd, n, d, 0.0, span, entry);
    clipPair(ro, rd, n * vec3(-1, 1, 1), d, 0.0, span, entry);
    clipPair(ro, rd, n * vec3(1, -1, 1), d, 0.0, span, entry);
    clipPair(ro, rd, n * vec3(1, 1, -1), d, 0.0, span, entry);
    return span;
}
void keepNearer(inout Hit h, vec2 span, vec3 nor, float d, vec3 origin, int id) {
    if (span.x < span.y && span.x > 0.0) h = Hit(span.x, vec4(nor, d + dot(nor, origin)), id);
}
vec3 toStar(vec3 v) { return vec3(turn(v.xz, 2.0 * kPi * cycles(0.0625)), v.y).xzy; }
vec3 fromStar(vec3 v) { return vec3(turn(v.xz, -2.0 * kPi * cycles(0.0625)), v.y).xzy; }
vec3 toGift(vec3 v) { return vec3(turn(v.xz, kGiftTurn), v.y).xzy; }
vec3 fromGift(vec3 v) { return vec3(turn(v.xz, -kGiftTurn), v.y).xzy; }

// ---- Ornaments ----------------------------------------------------------------------------------
// Up to 4096 spheres, and a hierarchy of boxes over them: a heap, in which node n has the children
// 2n and 2n + 1, so that it needs no pointers; leaves follow a Hilbert curve, so that neighbours in
// the heap are neighbours in space. A ray goes down where it meets a box, and skips the subtree
// where not. How does it come back without a stack? `trail` is a number with one bit a level: 0
// while the first child is looked at, 1 for the second. Adding 1 to it carries through all levels
// that are done, and the zeros that the carry leaves say how many levels up the next subtree lies
// (Laine). It is 1 again when the root is done.

vec4 texelOf(sampler2D buffer, int index, int row) {
    vec2 place = vec2(index & (kRow - 1), row + (index >> 6));
    return fetch(buffer, place, vec2(textureSize(buffer, 0)));
}
// Corners of a box: on each axis two whole numbers below 4096 share the 24 bits of a float.
void unpackBox(vec4 texel, out vec3 lo, out vec3 hi) {
    vec3 low = floor(texel.xyz / 4096.0);
    lo = low * kBoxGrid - kBoxOrigin;
    hi = (texel.xyz - low * 4096.0) * kBoxGrid - kBoxOrigin;
}
// A leaf's place on the curve: after the heap's deepest row come the leaves of the row above.
int leafPlace(int leaf) {
    int deepest = 1 << ((floatBitsToInt(float(ornaments - 1)) >> 23) - 126);
    return leaf >= deepest ? leaf - deepest : leaf + ornaments - deepest;
}
void meetOrnament(int id, vec4 s, vec3 ro, vec3 rd, inout Hit h) {
    float t = intersectSphere(ro, rd, s.xyz, abs(s.w));
    bool nearer = t < h.t || (t == h.t && id < h.id);   // so no order of tests can matter
    if (t > 0.0 && nearer) {
        h.t = t;
        h.id = id;
    }
}
// Share of a lamp's disc that a sphere leaves free; rim: slope of the disc's radius seen from ro.
float besideSphere(vec3 ro, vec3 rd, float rim, float tMax, vec4 s) {
    vec3 f = s.xyz - ro;
    float t = dot(f, rd), r = abs(s.w);
    float away = length(f - t * rd), disc = max(rim * t, 1e-6);
    float reach = smoothstep(0.0, 1.0, (r + disc - away) / (2.0 * min(r, disc)));
    float cover = t > 0.0 && t < tMax ? reach * min(1.0, square(r / disc)) : 0.0;
    return 1.0 - cover * (s.w < 0.0 ? 0.62 : 1.0);   // biased: glass dims, it does not focus
}
// Next node after a subtree is done: up by every level whose second child is done, then across.
void nextNode(inout int node, inout int trail) {
    trail += 1;
    int up = (floatBitsToInt(float(trail & -trail)) >> 23) - 127;   // its trailing zeros
    trail >>= up;
    node = (node >> up) ^ 1;
}

// A few spheres are cheaper one by one, behind the box round them all, than through a hierarchy.
bool inPlainLoop() { return acceleration < 2 || ornaments < kLeastForTree; }

// The plain loops: all ornaments, or none when the box round them all is missed.
int plainCount(vec3 ro, vec3 inv, float grow, float tMax) {
    vec3 lo, hi;
    unpackBox(texelOf(ornamentTree, 1, 128), lo, hi);
    return acceleration == 0 || meetsBox(ro, inv, lo - grow, hi + grow, tMax) ? ornaments : 0;
}

void hitOrnaments(vec3 ro, vec3 rd, inout Hit h) {
    vec3 lo, hi, inv = safeInverse(rd);
    if (inPlainLoop()) {
        int count = plainCount(ro, inv, 0.0, h.t);
        for (int k = 0; k < count; k += kBatch)
            for (int j = k; j < k + kBatch; ++j)
                if (j < ornaments) meetOrnament(j, texelOf(ornamentTree, j, 0), ro, rd, h);
        return;
    }
    int node = 1, trail = 1;
    for (int k = 0; k < kTreeSteps; ++k) {
        vec4 texel = texelOf(ornamentTree, node, 128);
        unpackBox(texel, lo, hi);
        bool leaf = node >= ornaments;
        if (leaf) meetOrnament(leafPlace(node), texel, ro, rd, h);
        if (!leaf && meetsBox(ro, inv, lo, hi, h.t)) {   // down, the nearer child first
            float axis = abs(texel.w), along = axis < 1.5 ? rd.x : axis < 2.5 ? rd.y : rd.z;
            node = 2 * node + (along * texel.w < 0.0 ? 1 : 0);
            trail *= 2;
        } else {
            nextNode(node, trail);
            if (trail == 1) break;
        }
    }
}

// A product of shares depends, in its last bit, on their order. So leaves come as the plain loop
// takes them, along the curve (the first child first, whatever the ray), and who lies in a box that
// is missed would have multiplied by exactly 1: with and without the hierarchy, the same bits.
float besideOrnaments(vec3 ro, vec3 rd, float rim, float tMax, float free) {
    vec3 lo, hi, inv = safeInverse(rd);
    if (inPlainLoop()) {
        int count = plainCount(ro, inv, rim * tMax, tMax);
        for (int k = 0; k < count && free > kLeastLight; k += kBatch)
            for (int j = k; j < k + kBatch; ++j)
                if (j < ornaments)
                    free *= besideSphere(ro, rd, rim, tMax, texelOf(ornamentTree, j, 0));
        return free;
    }
    int node = 1, trail = 1;
    for (int k = 0; k < kTreeSteps && free > kLeastLight; ++k) {
        vec4 texel = texelOf(ornamentTree, node, 128);
        unpackBox(texel, lo, hi);
        float far = dot(max((lo - ro) * rd, (hi - ro) * rd), vec3(1.0));   // the box's reach
        float grow = rim * far;
        bool leaf = node >= ornaments;
        if (leaf) free *= besideSphere(ro, rd, rim, tMax, texel);
        if (!leaf && far > 0.0 && meetsBox(ro, inv, lo - grow, hi + grow, tMax)) {
            node *= 2;
            trail *= 2;
        } else {
            nextNode(node, trail);
            if (trail == 1) break;
        }
    }
    return free;
}

// ---- Light --------------------------------------------------------------------------------------
// A lamp is a disc; from a point it is seen under a cone of slope radius / distance. What one thing
// hides of that cone is a closed form of how far the cone's axis passes from it; free shares of
// several things multiply. More, thinner cones (`shadowSamples`) make that exact.

Lamp lamp(int k) {
    if (k == 0) return Lamp(vec3(-3.4, 5.8, 5.0), 105.0 * lampPower * linearColour(keyColour));
    if (k == 1) return Lamp(vec3(4.5, 4.7, -3.3), 100.0 * lampPower * linearColour(roseColour));
    return Lamp(vec3(-4.6, 4.9, -3.6), 150.0 * lampPower * linearColour(coolColour));
}

// Share of a cone that a convex solid leaves free: where between the cone's rims its outline lies,
// from the spans of the cone's axis against the solid shrunk and widened by the cone.
float besideConvex(vec2 inner, vec2 outer) {
    float a = inner.x - inner.y, b = outer.x - outer.y;
    if (b >= 0.0) return 1.0;
    if (a <= 0.0) return 0.0;
    return smoothstep(0.0, 1.0, a / max(a - b, 1e-9));
}

// Share of one sub-disc of a lamp that a point sees.
float visibility(vec3 ro, vec3 rd, float rim, float tMax) {
    vec4 n;
    vec3 body = toGift(ro - kBodyCentre), lid = toGift(ro - kLidCentre), qd = toGift(rd);
    vec2 inner, outer;
    float free = 1.0;
    // Trunk, body, lid; each against the inner and the outer rim. Drivers unroll loops whose end
    // they know, and compile each copy.
    int solids = tMax > 0.0 ? 3 : 0, rims = tMax > 0.0 ? 2 : 0;
    for (int k = 0; k < solids; ++k) {
        for (int side = 0; side < rims; ++side) {
            float widen = side == 0 ? -rim : rim;
            outer = k == 0 ? clipTrunk(ro, rd, widen, tMax, n)
                : clipBox(k == 1 ? body : lid, qd, k == 1 ? kBodyHalf : kLidHalf, widen, tMax, n);
            if (side == 0) inner = outer;
        }
        free *= besideConvex(inner, outer);
    }
    for (int k = 0; k < orbitingBalls; ++k)
        free *= besideSphere(ro, rd, rim, tMax, fetch(moving, vec2(k, 1), vec2(256.0, 2.0)));
    free = besideOrnaments(ro, rd, rim, tMax, free);
    return max(free - kLeastLight, 0.0) / (1.0 - kLeastLight);
}

// Light that a matt surface sends on, for an albedo of 1.
vec3 irradiance(vec3 p, vec3 nor, bool fillLit, int lamps) {
    vec3 sum = vec3(0.0);
    int samples = shadows == 2 ? shadowSamples : 1;
    float spread = shadows == 2 ? lampRadius : 0.0, size = spread / sqrt(float(samples));
    for (int k = 0; k < lamps; ++k) {
        Lamp source = lamp(k);
        vec3 axis = source.pos - p;
        float far2 = dot(axis, axis), inverse = inversesqrt(far2);
        float cosine = dot(axis, nor) * inverse;
        float aim = dot(normalize(source.pos - kAim), axis) * inverse;
        float seen = cosine > 0.0 ? smoothstep(kSpotRim, kSpotCore, aim) : 0.0;
        if (seen <= 0.0) continue;
        if (shadows > 0) {
            vec3 beside = abs(axis.y) * inverse > 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0);
            vec3 u = normalize(cross(axis, beside)), v = cross(u, axis) * inverse;
            float sees = 0.0;
            for (int j = 0; j < samples; ++j) {   // sub-discs on a phyllotaxis; one is the lamp
                float a = 2.0 * kPi * kGolden * float(j);
                float r = (spread - size) * sqrt((float(j) + 0.5) / float(samples));
                vec3 to = axis + r * (u * cos(a) + v * sin(a));
                float far = length(to);
                sees += visibility(liftOff(p, nor), to / far, size / far, far);
            }
            seen *= sees / float(samples);
        }
        sum += source.power * (seen * cosine / far2);
    }
    // The string as one warm core on the axis, the star above it; both without shadows.
    vec3 core = vec3(0.0, clamp(p.y, 0.7, 2.6), 0.0) - p;
    float cc = dot(core, core) + 0.35;
    float wrapped = 0.35 + 0.65 * max(dot(core, nor) * inversesqrt(cc), 0.0);
    sum += vec3(1.0, 0.52, 0.20) * (0.0022 * float(fairyLights) * fairyGlow * wrapped / cc);
    vec3 up = kStarCentre - p;
    float uu = dot(up, up) + 0.05;
    sum += vec3(1.0, 0.66, 0.28) * (1.2 * starGlow * max(dot(up, nor) * inversesqrt(uu), 0.0) / uu);
    sum += nightSky * mix(vec3(0.020, 0.013, 0.014), vec3(0.020, 0.028, 0.065), 0.5 + 0.5 * nor.y);
    if (fillLit) {
        vec3 fill = vec3(0.5, 2.2, 7.0) - p;
        sum += fillLight * (0.05 + 0.45 * max(dot(fill, nor) * inversesqrt(dot(fill, fill)), 0.0));
    }
    return sum;
}

// What glows along a ray before tMax: fairy lights, the star, and for mirrors the lamps. The ray's
// footprint is width0 + width * t.
vec3 glow(vec3 ro, vec3 rd, float tMax, float width0, float width, bool mirrored) {
    bool near = meetsBox(ro, safeInverse(rd), vec3(-1.7, 0.2, -1.7), vec3(1.7, 3.9, 1.7), tMax);
    int count = near ? fairyLights : 0;
    float faint = 3.2 / float(max(fairyLights, 80));   // halos of a dense string would make fog
    float string = 0.0;
    for (int k = 0; k < count; k += 4)
        for (int j = k; j < k + 4; ++j) {   // those past the end are dark
            vec4 light = fetch(moving, vec2(j, 0), vec2(256.0, 2.0));
            vec3 f = light.xyz - ro;
            float t = dot(f, rd), seen = max(0.024, 1.2 * (width0 + width * t));
            vec3 l = f - t * rd;
            float away2 = dot(l, l), shrink = 1.0 / (seen * seen);
            float core = square(max(1.0 - away2 * shrink, 0.0)) * shrink;
            float halo = square(max(1.0 - away2 * 16.0, 0.0));
            if (t > 0.0 && t < tMax + 0.02)
                string += light.w * (0.0085 * core + faint * square(square(halo)));
        }
    // The star: its light scattered by thin haze, in closed form, and a cross as in a lens.
    vec3 f = kStarCentre - ro;
    float t = dot(f, rd);
    vec3 l = f - t * rd;
    float away2 = dot(l, l), away = sqrt(away2 + 0.02), side = length(l.xz);
    float haze = exp(-0.5 * away) * (atan((tMax - t) / away) + atan(t / away)) / away;
    float arms = exp(-4.0 * abs(l.y)) / (1.0 + square(side / 0.01))
        + exp(-5.0 * side) / (1.0 + square(l.y / 0.01));
    float bloom = (1.0 - smoothstep(0.0, 0.4, away2)) / (0.15 + 20.0 * away2);
    float ahead = t > 0.0 && t < tMax + 0.5 ? 1.0 : 0.0;
    vec3 sum = string * vec3(1.0, 0.60, 0.24);
    sum += vec3(1.0, 0.56, 0.18)
        * (starGlow * (0.013 * haze + ahead * (0.8 * arms + 0.04 * bloom)));
    if (mirrored)
        for (int k = 0; k < 3; ++k) {
            Lamp source = lamp(k);
            vec3 g = source.pos - ro;
            float s = dot(g, rd), seen = 0.30 + width0 + width * max(s, 0.0);
            float d2 = max(dot(g, g) - s * s, 0.0) / (seen * seen);
            float disc = (0.017 * exp(-d2 * d2) + 0.0004 / (1.0 + d2)) / (seen * seen);
            if (s > 0.0 && s < tMax) sum += source.power * disc;
        }
    return sum;
}

// ---- Materials ----------------------------------------------------------------------------------
// Patterns are means over the pixel's footprint: the mean over [a, b] of a line is the difference
// of its integral at both ends, over b - a. A path then goes on: mirrored; or through a glass ball,
// which is two bends and a chord between them, worked out in one go since a sphere looks the same
// from everywhere within.

// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}

// Colour of the floor and the tilt of its planks. foot: the pixel's footprint along x and z, m.
vec3 floorAlbedo(vec3 p, vec2 foot, inout vec3 nor) {
    float row = floor(p.x / kPlank), along = p.z / kPlankLength + random3(ivec3(int(row), 7, 1)).x;
    vec3 plank = random3(ivec3(int(row), int(floor(along)), 2));
    vec2 apart = clamp(1.5 - foot / vec2(kPlank, kPlankLength), 0.0, 1.0);
    float distinct = apart.x * apart.y;
    vec2 texels = foot / kWoodTile * kWoodTexels, corner = floor(plank.xy * 64.0) / 64.0;
    float lod = log2(max(max(texels.x, texels.y), 1.0));
    vec3 grain = textureLod(wood, p.xz / kWoodTile + corner, lod).rgb;
    float seam = max(lines(p.x / kPlank, 0.01, foot.x / kPlank),
                     lines(along, 0.0007, foot.y / kPlankLength));
    vec2 tilt = (plank.xy - 0.5) * 0.008 * distinct + (grain.b - 0.5) * vec2(0.006, 0.0015);
    nor = normalize(vec3(tilt, 1.0).xzy);
    return mix(vec3(0.125, 0.043, 0.012), vec3(0.54, 0.255, 0.080), grain.r)
        * mix(1.0, 0.72 + 0.56 * plank.z, distinct) * (1.0 - 0.55 * grain.g) * (1.0 - 0.85 * seam);
}

// One layer of stars in square cells. None is smaller than the footprint w: dimmer instead.
vec3 starLayer(vec2 uv, float cell, float radius, float w, int seed) {
    vec2 c = floor(uv / cell);
    uvec3 bits = hash3(ivec3(ivec2(c), seed));
    vec3 a = vec3(bits & 65535u) / 65536.0, b = vec3(bits >> 16u) / 65536.0;
    vec2 d = uv / cell - c - 0.3 - 0.4 * a.xy;
    float r = radius * (0.5 + a.z), seen = min(max(r, 0.75 * w), 0.14 * cell);
    float twinkle = sin(2.0 * kPi * (b.y + cycles(0.125 + 0.25 * floor(b.z * 4.0))));
    float shine = square(square(b.x * b.x * b.x)) * (0.75 + 0.25 * twinkle);   // few are bright
    float disc = exp(-dot(d, d) * square(cell / seen)) * square(r / seen);
    return mix(vec3(0.65, 0.78, 1.0), vec3(1.0, 0.86, 0.66), b.z)
        * (shine * disc * clamp(2.0 - 3.0 * w / cell, 0.0, 1.0));
}

// Inside of a rectangle, 1 to 0 over the last part `soft` of its half size; p in half sizes.
float panel(vec2 p, float soft) {
    vec2 inside = 1.0 - smoothstep(1.0 - soft, 1.0, abs(p));
    return inside.x * inside.y;
}

// Walls and sky: night blue, stars, and on one wall a window and a doorway, which the mirrors show.
vec3 nightWall(vec3 p, vec3 nor, float w) {
    bool sky = nor.y < -0.5;
    vec2 uv = sky ? p.xz : vec2(abs(nor.x) > 0.5 ? p.z : p.x, p.y), uv2 = uv * uv;
    int seed = sky ? 90 : 10 + int(nor.x * 2.0 + nor.z * 3.0 + 5.0) * 8;
    float up = sky ? 1.0 : clamp(p.y / kRoom.y, 0.0, 1.0);
    float middle = exp(-0.03 * (sky ? min(uv2.x, uv2.y) : uv2.x));
    vec3 sum = mix(vec3(0.0022, 0.0026, 0.011), vec3(0.018, 0.036, 0.17), smoothstep(0.0, 0.9, up));
    sum *= mix(0.45, 1.0, middle) * (1.0 + 0.15 * nor.x);   // the corners can be read
    vec2 moon = uv - vec2(-1.5, 1.0);
    if (sky) sum += vec3(0.55, 0.85, 1.40) * exp(-0.05 * dot(moon, moon));
    float band = exp(-0.22 * square(uv.y - 5.2 - 0.4 * uv.x));   // a milky way
    sum += band * vec3(0.006, 0.008, 0.024);
    vec3 stars = starLayer(uv, 0.13, 0.005, w, seed) * (3.0 + 11.0 * band);
    stars += starLayer(uv + 0.31, 0.60, 0.008, w, seed + 2) * 34.0;
    stars += starLayer(uv + 0.17, 1.7, 0.013, w, seed + 4) * 45.0;
    sum += stars * mix(0.5, 1.0, up);
    if (nor.z < -0.5) {
        float soft = min(0.02 + w, 1.0);
        vec2 q = (p.xy - vec2(-3.4, 4.4)) / vec2(2.3, 3.2), d = p.xy - vec2(4.2, 1.7);
        vec2 bars = smoothstep(0.035, 0.035 + soft, abs(vec2(q.x, abs(q.y) - 0.34)));
        vec3 night = mix(vec3(0.9, 1.2, 1.8), vec3(1.5, 2.1, 3.4), 0.5 + 0.5 * q.y);
        sum += panel(q, soft) * bars.x * bars.y * night;   // six panes
        sum += panel(d / vec2(1.0, 1.75), soft) * vec3(3.2, 1.45, 0.48) * (0.75 - 0.14 * d.y);
        sum += vec3(0.16, 0.075, 0.030) / (1.0 + 0.10 * dot(d, d));   // the lit hall's wash
    }
    return sum * nightSky;
}

// Flakes on vertical cylinders round the tree: each is met twice, before the axis and behind it.
vec3 snowfall(vec3 ro, vec3 rd, float tMax, float pixel) {
    float a = max(dot(rd.xz, rd.xz), 1e-6), b = dot(ro.xz, rd.xz), c = dot(ro.xz, ro.xz);
    vec2 sway = vec2(cycles(0.1875), cycles(0.125));
    float sum = 0.0;
    for (int k = 0; k < 24; ++k) {
        int shell = k >> 1;
        float radius = 1.9 + 0.5 * float(shell), disc = b * b - a * (c - radius * radius);
        float t = (-b + float((k & 1) * 2 - 1) * sqrt(max(disc, 0.0))) / a;
        vec3 p = ro + t * rd;
        float columns = floor(2.0 * kPi * radius / kFlakeCell);
        float hz = snowSpeed / (kFlakeCell * kFlakeRows);
        vec2 uv = vec2((atan(p.x, p.z + 1e-9) / (2.0 * kPi) + 0.5) * columns, p.y / kFlakeCell);
        uv.y += kFlakeRows * cycles(hz * (0.8 + 0.04 * float(shell)));
        vec2 cell = floor(uv), wrapped = mod(cell + 0.5, vec2(columns, kFlakeRows));
        vec3 r = random3(ivec3(ivec2(wrapped), 200 + shell));
        vec2 swung = 0.16 * sin(2.0 * kPi * (r.yx + sway));
        vec2 at = (uv - cell - 0.35 - 0.3 * r.xy - swung) * kFlakeCell;
        float size = mix(0.006, 0.016, r.z), seen = max(size, 0.8 * pixel * t);
        float side = smoothstep(0.0, 0.3 * radius * radius, disc);   // not where edge on
        float flake = exp(-dot(at, at) / (seen * seen)) * square(size / seen) * side;
        bool there = fract(r.z * 97.0) < snow && t > 0.6 && t < tMax && p.y < kRoom.y;
        if (there) sum += flake;
    }
    return vec3(0.62, 0.72, 0.95) * sum;
}

// The room seen without detail: floor, horizon, night above.
vec3 surroundings(vec3 rd) {
    vec3 level = vec3(0.030, 0.028, 0.040), below = vec3(0.26, 0.10, 0.036) * lampPower;
    vec3 away = rd.y < 0.0 ? below : vec3(0.16, 0.25, 0.48) * nightSky;
    return mix(level, away, smoothstep(0.0, 0.8, abs(rd.y)));
}

Hit closestHit(vec3 ro, vec3 rd) {
    Hit h = Hit(kFar, vec4(0.0), kWall);
    hitOrnaments(ro, rd, h);
    for (int k = 0; k < orbitingBalls; ++k) {
        vec4 s = fetch(moving, vec2(k, 1), vec2(256.0, 2.0));
        float t = intersectSphere(ro, rd, s.xyz, s.w);
        if (t > 0.0 && t < h.t) {
            h.t = t;
            h.id = kBall + k;
        }
    }
    vec4 n;
    vec2 span = clipTrunk(ro, rd, 0.0, h.t, n);
    keepNearer(h, span, n.xyz, n.w, vec3(0.0), kTrunk);
    span = clipStar(toStar(ro - kStarCentre), toStar(rd), h.t, n);
    keepNearer(h, span, fromStar(n.xyz), n.w, kStarCentre, kStar);
    vec3 qd = toGift(rd);
    span = clipBox(toGift(ro - kBodyCentre), qd, kBodyHalf, 0.0, h.t, n);
    keepNearer(h, span, fromGift(n.xyz), n.w, kBodyCentre, kBody);
    span = clipBox(toGift(ro - kLidCentre), qd, kLidHalf, 0.0, h.t, n);
    keepNearer(h, span, fromGift(n.xyz), n.w, kLidCentre, kLid);
    // The room from inside: the nearest of the planes ahead, which the inverse knows for a zero
    // too.
    vec3 inverse = safeInverse(rd), ahead = mix(-kRoom, kRoom, greaterThan(inverse, vec3(0.0)));
    ahead.y = max(ahead.y, 0.0);
    vec3 far = max((ahead - ro) * inverse, 0.0);
    float t = min(far.x, min(far.y, far.z));
    if (t < h.t) {
        vec3 axis = t == far.y ? vec3(0, 1, 0) : t == far.x ? vec3(1, 0, 0) : vec3(0, 0, 1);
        vec3 nor = dot(axis, rd) > 0.0 ? -axis : axis;
        h = Hit(t, vec4(nor, dot(nor, ahead * axis)), nor.y > 0.5 ? kFloor : kWall);
    }
    return h;
}

// Red paper with golden dots and ribbon, a golden lid with a red one. face: |normal| of the box.
vec3 giftAlbedo(vec3 q, vec3 face, bool lid, float w) {
    vec2 across = face.y > 0.5 ? q.xz : face.x > 0.5 ? q.zy : q.xy;
    float band = face.y > 0.5 ? min(abs(q.x), abs(q.z)) : abs(across.x);
    float gold = 1.0 - smoothstep(0.075 - 0.5 * w, 0.0751 + 0.5 * w, band);
    float dots = 1.0 - smoothstep(0.013 - 0.5 * w, 0.0131 + 0.5 * w,
                                  0.084 * length(fract(across / 0.084 + 0.5) - 0.5));
    if (!lid) gold = max(gold, 0.6 * dots * clamp(1.5 - 20.0 * w, 0.0, 1.0));
    return mix(vec3(0.50, 0.008, 0.014), vec3(0.80, 0.66, 0.07), lid ? 1.0 - gold : gold);
}

vec3 metal(vec3 tint, float cosine) { return mix(tint, vec3(1.0), pow(1.0 - cosine, 5.0)); }

// From the outside of a glass ball through it: rd and nor become those of the way out. Biased: what
// an inner reflection sends elsewhere is left out, total reflection is followed.
vec3 throughGlass(inout vec3 rd, inout vec3 nor, float r) {
    float eta = 1.0 / kIorGlass, cosine = clamp(-dot(rd, nor), 0.0, 1.0);
    vec3 share = vec3(1.0 - fresnel(cosine, kIorGlass));
    float k2 = (1.0 - eta) * (1.0 + eta) + square(eta * cosine);
    rd = normalize(eta * rd + (eta * cosine - sqrt(k2)) * nor);
    for (int k = 0; k < 3; ++k) {   // chords
        float chord = -2.0 * r * min(dot(nor, rd), 0.0);
        nor = normalize(r * nor + chord * rd);
        share *= exp(-chord * vec3(0.16, 0.06, 0.10));   // 1/m, thick glass is a little green
        cosine = clamp(dot(nor, rd), 0.0, 1.0);
        k2 = (1.0 - kIorGlass) * (1.0 + kIorGlass) + square(kIorGlass * cosine);
        if (k2 > 0.0) {
            rd = normalize(kIorGlass * rd - (kIorGlass * cosine - sqrt(k2)) * nor);
            return share * (1.0 - fresnel(cosine, eta));
        }
        rd = normalize(reflect(rd, nor));
    }
    return share;
}

// What a path carries on: a ray, the share of its light that reaches the eye, and its footprint,
// which is width0 at its start and gains `width` a metre.
struct Leg {
    vec3 ro, rd, throughput;
    float width0, width;
};
// What a ray meets, as light sees it.
struct Surface {
    vec3 p, facing;                 // place, and outward normal
    vec3 nor;                       // the normal that mirrors: planks tilt
    vec3 mirror, albedo, shine;     // share that goes on mirrored; colour; light of its own
    vec4 ball;                      // of a sphere: centre and radius, negative for glass; or 0
    float w, cosine;                // footprint; between the ray and the normal
};

// Back onto the surface, whatever the rounding of a long ray.
Surface arrive(Leg leg, Hit h) {
    Surface s;
    s.p = leg.ro + h.t * leg.rd;
    s.facing = h.face.xyz;
    s.ball = vec4(0.0);
    if (h.id < kFloor) s.ball = texelOf(ornamentTree, h.id, 0);
    if (h.id >= kBall) s.ball = fetch(moving, vec2(h.id - kBall, 1), vec2(256.0, 2.0));
    if (s.ball.w != 0.0) {
        s.facing = normalize(s.p - s.ball.xyz);
        s.p = s.ball.xyz + abs(s.ball.w) * s.facing;
    } else {
        s.p -= (dot(s.facing, s.p) - h.face.w) * s.facing;
    }
    s.nor = s.facing;
    s.mirror = s.albedo = s.shine = vec3(0.0);
    s.w = leg.width0 + leg.width * h.t;
    s.cosine = clamp(-dot(leg.rd, s.facing), 0.0, 1.0);
    return s;
}

// The room, the trunk, the star, the gift.
void clotheFlat(int id, vec3 rd, inout float width, inout Surface s) {
    if (id == kWall) {
        s.shine += nightWall(s.p, s.nor, s.w / max(s.cosine, 0.2));
    } else if (id == kFloor) {
        vec2 slope = rd.xz / max(-rd.y, 1e-4);
        s.albedo = floorAlbedo(s.p, min(s.w * sqrt(1.0 + slope * slope), vec2(20.0)), s.nor);
        float level = clamp(-dot(rd, s.nor), 0.0, 1.0);
        s.mirror = vec3(floorGloss * fresnel(level, kIorVarnish));
        width += 0.03;   // rad, the varnish is satin
    } else if (id == kTrunk) {   // gilt courses with grooves between them
        float polish = 1.0 - 0.75 * lines(s.p.y / 0.15, 0.035, s.w / 0.15);
        s.albedo = vec3(0.24, 0.115, 0.03) * polish;
        s.mirror = metal(vec3(0.52, 0.34, 0.13), s.cosine) * polish;
    } else if (id == kStar) {
        s.shine += vec3(1.0, 0.50, 0.09) * (starGlow * (0.35 + 1.9 * s.cosine * s.cosine));
        s.mirror = 0.5 * metal(vec3(0.90, 0.62, 0.22), s.cosine);
    } else {
        s.albedo = giftAlbedo(toGift(s.p - kBodyCentre), abs(toGift(s.nor)), id == kLid, s.w);
        s.mirror = vec3(fresnel(s.cosine, kIorVarnish));
    }
}
// Ornaments and small balls. A footprint w on a ball of radius r spans the angle w / r; mirrored, 2
// w / r.
void clotheRound(int id, inout float width, inout Surface s) {
    if (id < kFloor) {
        s.mirror = s.ball.w < 0.0 ? vec3(fresnel(s.cosine, kIorGlass))
            : metal(texelOf(ornamentTree, id, 64).rgb, s.cosine);
        width += 2.0 * s.w / (abs(s.ball.w) * max(s.cosine, 0.04));
    } else {
        s.albedo = (id & 1) == 0 ? vec3(0.85, 0.52, 0.02) : vec3(0.62, 0.012, 0.02);
        s.mirror = vec3(fresnel(s.cosine, kIorVarnish));
        width += 2.0 * s.w / s.ball.w;
    }
}

// From a surface on. In glass the refracted ray goes on, and the mirrored one takes the queue's one
// place if it is brighter than what waits there.
void goOn(Surface s, inout Leg leg, inout Leg later) {
    vec3 reflected = reflect(leg.rd, s.nor);   // and above the surface, though its planks tilt
    reflected += max(1e-4 - dot(reflected, s.facing), 0.0) * s.facing;
    vec3 mirrored = leg.throughput * s.mirror;
    leg.width0 = s.w;
    if (s.ball.w < 0.0) {
        if (maxComponent(mirrored) > maxComponent(later.throughput))
            later = Leg(liftOff(s.p, s.nor), normalize(reflected), mirrored, s.w, leg.width);
        vec3 nor = s.nor;
        leg.throughput *= throughGlass(leg.rd, nor, abs(s.ball.w));
        leg.ro = liftOff(s.ball.xyz + abs(s.ball.w) * nor, nor);
    } else {
        leg.ro = liftOff(s.p, s.facing);
        leg.rd = normalize(reflected);
        leg.throughput = mirrored;
    }
}

// Light that arrives at ro against rd. pixel: angle of a pixel, rad.
vec3 radiance(vec3 ro, vec3 rd, float pixel) {
    vec3 sum = vec3(0.0);
    Leg leg = Leg(ro, rd, vec3(1.0), 0.0, pixel);
    Leg later = Leg(ro, rd, vec3(0.0), 0.0, pixel);
    for (int ray = 0; ray < bounces; ++ray) {
        Hit h = closestHit(leg.ro, leg.rd);
        Surface s = arrive(leg, h);
        s.shine = glow(leg.ro, leg.rd, h.t, leg.width0, leg.width, ray > 0);
        if (snow > 0.0 && ray == 0) s.shine += snowfall(leg.ro, leg.rd, h.t, pixel);
        if (s.ball.w != 0.0) clotheRound(h.id, leg.width, s);
        else clotheFlat(h.id, leg.rd, leg.width, s);
        int lamps = maxComponent(leg.throughput * s.albedo) > kLeastThroughput ? 3 : 0;
        vec3 matt = s.albedo * irradiance(s.p, s.facing, h.id >= kBall, lamps);
        sum += leg.throughput * (s.shine + (1.0 - s.mirror) * matt);
        goOn(s, leg, later);
        // Biased: the surroundings stand for what a wide cone gathers.
        if (leg.width > mirrorBlur) {
            sum += leg.throughput * surroundings(leg.rd);
            leg.throughput = vec3(0.0);
        }
        if (maxComponent(leg.throughput) < kLeastThroughput) {
            if (maxComponent(later.throughput) < kLeastThroughput) break;
            leg = later;
            later.throughput = vec3(0.0);
        }
    }
    return sum;
}

// ---- Passes -------------------------------------------------------------------------------------
// Built when the number of ornaments changes, and then kept: where they are, their order along the
// Hilbert curve (each counts how many come before it), and the boxes, from the leaves up. Each
// frame only the few things that move are placed.

float tiledNoise(vec2 unit, ivec2 period, int seed) {   // value noise on a torus
    vec2 p = unit * vec2(period), f = fract(p), s = f * f * (3.0 - 2.0 * f);
    ivec2 a = ivec2(p) % period, b = (a + 1) % period;   // unit in [0, 1)
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}

// Grain: r tone, g dark pores, b waviness of the varnish. A tile of kWoodTile, without a seam.
void mainWood(out vec4 colour, in vec2 pixel) {
    vec2 p = pixel / kWoodTexels;
    float bend = tiledNoise(p, ivec2(6, 5), 1) + 0.5 * tiledNoise(p, ivec2(12, 13), 2);
    float rings = 0.5 + 0.5 * sin(2.0 * kPi * (10.0 * p.x + 2.2 * bend));
    float streak = tiledNoise(p, ivec2(90, 7), 3), fibre = tiledNoise(p, ivec2(230, 22), 4);
    float pores = smoothstep(0.72, 0.95, tiledNoise(p, ivec2(256, 60), 5));
    float tone = 0.12 + 0.30 * rings * rings + 0.32 * streak + 0.22 * fibre + 0.2 * (bend - 0.75);
    colour = vec4(clamp(tone, 0.0, 1.0), pores * (0.35 + 0.65 * rings),
                  tiledNoise(p, ivec2(24, 40), 6), 1.0);
}

// Index along a Hilbert curve of 2^8 cells a side: neighbours on the curve are neighbours in space.
float hilbertIndex(uvec3 x) {
    for (uint q = 128u; q > 1u; q >>= 1u)
        for (int i = 0; i < 3; ++i) {
            uint swap = (x[i] & q) == 0u ? (x.x ^ x[i]) & (q - 1u) : 0u;
            if ((x[i] & q) != 0u) x.x ^= q - 1u;
            x.x ^= swap;
            if (i > 0) x[i] ^= swap;
        }
    x.y ^= x.x;
    x.z ^= x.y;
    uint flip = 0u, index = 0u;
    for (uint q = 128u; q > 1u; q >>= 1u)
        if ((x.z & q) != 0u) flip ^= q - 1u;
    x ^= uvec3(flip);
    for (uint b = 8u; b > 0u; --b) {
        uvec3 bit = (x >> (b - 1u)) & 1u;
        index = index * 8u + bit.x * 4u + bit.y * 2u + bit.z;
    }
    return float(index);   // 24 bits: exact
}

// Ornament i by its formula: centre, radius. Tiers for 16, else a phyllotaxis on one or two cones.
vec4 placeOrnament(int i) {
    if (ornaments <= 16) {
        int tier = i < 6 ? 0 : i < 11 ? 1 : 2;
        float k = float(tier == 0 ? i : tier == 1 ? i - 6 : i - 11), count = tier == 0 ? 6.0 : 5.0;
        vec3 shape = tier == 0 ? vec3(0.93, 1.16, 0.41)
            : tier == 1 ? vec3(0.70, 2.08, 0.30) : vec3(0.44, 2.86, 0.19);   // ring, height, radius
        float a = 2.0 * kPi * (k + 0.35 * float(tier)) / count;
        return vec4(shape.x * sin(a), shape.y, shape.x * cos(a), shape.z);
    }
    float index = float(i), inner = ornaments < 500 ? 0.0 : 0.78;   // the second shell's scale
    float outside = floor(float(ornaments) / (1.0 + inner * inner) + 0.5);
    float shell = step(outside, index), first = shell * outside, size = mix(1.0, inner, shell);
    float count = mix(outside, float(ornaments) - outside, shell);
    float s = mix(0.10, 1.0, (index - first + 0.5) / count);   // 0 at the apex, 1 at the rim
    float a = 2.0 * kPi * fract((index - first) * kGolden + 0.37 * shell);
    // The lattice's least gap is 0.87 of the root of a point's area; near the apex the core limits.
    float ring = kConeRadius * size * s, slant = length(vec2(kConeHeight, kConeRadius)) * size;
    float most = 0.43 * sqrt(2.0 * kPi * ring * slant / count);
    float r = min(most * mix(0.74, 1.0, random3(ivec3(i, 3, 5)).x), min(0.42 * s * size, 0.30));
    return vec4(ring * sin(a), kConeApex - kConeHeight * s * mix(1.0, size, 0.4), ring * cos(a), r);
}

void mainPlaces(out vec4 colour, in vec2 pixel) {
    int row = int(pixel.y), i = int(pixel.x) + kRow * (row & 63);
    colour = vec4(0.0);
    if (i >= ornaments) return;
    vec4 s = placeOrnament(i);
    vec3 r = random3(ivec3(i, 11, 3));
    if (row < 64) {
        bool isGlass = fract((float(i) + 0.5) * kGolden + 0.17) < glass;
        colour = vec4(s.xyz, isGlass ? -s.w : s.w);
        return;
    }
    vec3 tint = linearColour(ornamentTint) * mix(0.75, 1.25, r.z);
    float lane = ornaments <= 16 ? r.x : fract(float(i % 21) / 21.0 + 0.3);   // spirals on the cone
    if (lane < accents) tint = vec3(0.66, 0.035, 0.045);
    if (lane < 0.6 * accents) tint = vec3(0.86, 0.54, 0.16);
    vec3 cell = clamp((s.xyz + vec3(2, 0, 2)) * 64.0, 0.0, 255.0);
    colour = vec4(min(tint, 1.0), hilbertIndex(uvec3(cell)));
}

void mainRanks(out vec4 colour, in vec2 pixel) {
    int i = int(pixel.x) + kRow * int(pixel.y);
    float key = texelOf(ornamentPlaces, i, 64).w, rank = 0.0;
    if (i < ornaments)
        for (int j = 0; j < ornaments; ++j) {
            float other = texelOf(ornamentPlaces, j, 64).w;
            if (other < key || (other == key && j < i)) rank += 1.0;
        }
    colour = vec4(rank);
}

// Rows 0-63 spheres in Hilbert order, 64-127 their colours, 128-255 a heap of 2n - 1 nodes: the
// spheres again as leaves, above them boxes; their fourth number is the axis along which the
// children lie (1 to 3), negative if the first child is the farther along it.
void mainTree(out vec4 colour, in vec2 pixel) {
    int row = int(pixel.y), index = int(pixel.x) + kRow * row, node = index - 128 * kRow;
    int first = index & 4095, last = first;
    if (row >= 128) {
        int left = max(node, 1), right = left;
        while (left < ornaments) left *= 2;
        while (right < ornaments) right = 2 * right + 1;
        first = leafPlace(left);
        last = leafPlace(right);
    }
    colour = vec4(0.0);
    if (first >= ornaments || node == 0 || node >= 2 * ornaments) return;
    vec3 lo = vec3(kFar), hi = vec3(-kFar), apart = vec3(0.0);
    vec4 sphere = vec4(0.0), tint = vec4(0.0);
    for (int j = 0; j < ornaments; ++j) {
        int rank = int(texelOf(ornamentRanks, j, 0).x);
        if (rank < first || rank > last) continue;
        sphere = texelOf(ornamentPlaces, j, 0);
        tint = texelOf(ornamentPlaces, j, 64);
        float r = abs(sphere.w) * 1.0001;   // a sphere hit by a rounding must lie in its box
        lo = min(lo, sphere.xyz - r);
        hi = max(hi, sphere.xyz + r);
        apart += sphere.xyz * (float(2 * rank - first - last));
    }
    vec3 size = abs(apart);
    float axis = size.x >= size.y && size.x >= size.z ? 1.0 : size.y >= size.z ? 2.0 : 3.0;
    float sense = axis < 1.5 ? apart.x : axis < 2.5 ? apart.y : apart.z;
    vec3 low = clamp(floor((lo + kBoxOrigin) / kBoxGrid), 0.0, 4095.0);
    vec3 high = clamp(ceil((hi + kBoxOrigin) / kBoxGrid), 0.0, 4095.0);
    colour = row < 64 || (row >= 128 && node >= ornaments) ? sphere : row < 128 ? tint
        : vec4(low * 4096.0 + high, sense < 0.0 ? -axis : axis);
}

// Row 0 fairy lights and their brightness, row 1 the circling balls.
void mainMoving(out vec4 colour, in vec2 pixel) {
    int k = int(pixel.x), row = int(pixel.y);
    float share = (float(k) + 0.5) / float(max(fairyLights, 1));
    vec3 r = random3(ivec3(k, 5, 9));
    if (row == 0) {
        float turns = r.y + cycles(0.25 + 0.125 * floor(r.z * 5.0));
        float light = k < fairyLights ? fairyGlow * (0.8 + 0.2 * sin(2.0 * kPi * turns)) : 0.0;
        float s = sqrt(mix(0.02, 1.0, share)), a = 14.0 * kPi * s;   // a spiral round the cone
        float radius = mix(0.10, 1.24, s), y = 3.45 - 2.85 * s;
        if (ornaments <= 16) {   // or four rings between the tiers, each stepping down to the next
            float along = share * 2.96;
            vec4 ring = vec4(1.22, 0.64, 1.22, 0.64);   // radius, height, and those of the next
            float start = 1.74;
            if (along < 1.74) {
                ring = vec4(0.92, 1.67, 1.22, 0.64);
                start = 0.82;
            }
            if (along < 0.82) {
                ring = vec4(0.60, 2.50, 0.92, 1.67);
                start = 0.22;
            }
            if (along < 0.22) {
                ring = vec4(0.22, 3.24, 0.60, 2.50);
                start = 0.0;
            }
            float round = (along - start) / ring.x;
            vec2 here = mix(ring.xy, ring.zw, smoothstep(0.86, 1.0, round));
            a = 2.0 * kPi * round;
            radius = here.x;
            y = here.y;
        }
        colour = vec4(radius * sin(a), y + 0.03 * (r.z - 0.5), radius * cos(a), light);
    } else {
        bool low = k % 3 == 2;   // low ones pass outside the gift, the others above it
        float j = floor(float(k) / 3.0) * (low ? 1.0 : 2.0) + float(k % 3) * (low ? 0.0 : 1.0);
        float radius = low ? 2.75 + 0.32 * j : 1.86 + 0.14 * mod(j, 3.0);
        float y = low ? 0.34 + 0.2 * j : 1.25 + 0.27 * mod(j * 3.0, 8.0);
        float hz = (low ? 0.03125 : 0.046875) * ((k & 1) == 0 ? 1.0 : 0.8125);
        float a = 2.0 * kPi * (kGolden * float(k) + cycles(hz));
        colour = vec4(radius * sin(a), y, radius * cos(a), 0.1);
    }
}

// ---- Image --------------------------------------------------------------------------------------
// The eye goes round the tree. One ray goes through the middle of a pixel: what a pixel shows in
// the mean is the business of footprints, above.

// Light to display: clamped first, then the largest channel rolls off, the others keep their ratio
// to it, with a little white at the top as on film; then sRGB. NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// What hides the bands of a smooth picture of 255 steps: half a step, up or down by chance. It is
// the same for all samples of a pixel: their mean is rounded, and of many none would be left.
vec3 dither(vec2 fragCoord) {
    vec3 chance = random3(ivec3(16 * ivec2(fragCoord) + 8, 3));
    return (chance + chance.yzx - 1.0) * (0.5 / 255.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    float height = clamp(cameraHeight - 4.0 * orbit.y, 0.1, 6.0);
    vec3 ro = vec3(cameraDistance * sin(angle), height, cameraDistance * cos(angle));
    vec3 right = vec3(cos(angle), 0.0, -sin(angle));
    vec3 forward = normalize(vec3(0.0, targetHeight, 0.0) + targetShift * right - ro);
    right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(right, forward);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float lens = focalLength / 24.0;
    vec3 rd = normalize(uv.x * right + uv.y * up + lens * forward);
    float falloff = square(dot(rd, forward));   // half of a simple lens's cos^4
    vec3 light = radiance(ro, rd, 1.0 / (lens * iResolution.y));
    fragColor = vec4(display(exp2(exposure) * falloff * light) + dither(fragCoord), 1.0);
}
