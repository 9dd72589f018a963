// Christmas: a modernist tree in a night room.
//
// A golden pyramid trunk under a glowing octahedral star, three tiers of mirror and glass spheres, a gift, small balls
// that circle the tree, fairy lights and, if wanted, snow. Three coloured lamps throw soft shadows that overlap on a
// planked floor. With more ornaments the spheres shrink and fill a cone; the hierarchy keeps their price near log n.
//
// Method   One path per pixel: closest hit, direct light, then one continuing ray (mirror, floor, varnish) or, in
//          glass, the refracted path first and the reflected one afterwards from a one-place queue. No recursion.
//          Shadows are cones from the surface to `shadowSamples` sub-discs of a lamp. How much of a sub-disc one
//          occluder hides is a closed form, and several occluders multiply: smooth with a single cone, and exact in
//          the limit of many. Ornaments lie in Hilbert order under a complete binary tree of boxes, walked without a
//          stack: a trail of bits remembers which levels have their second child still to come.
//          Trunk and star are the triangles of convex solids, found by clipping the ray with their faces' half-spaces:
//          neighbours share the plane equations, so no edge can leak.
// Sources  Haines, Guenther, Akenine-Moeller, Ray Tracing Gems ch. 7 (2019), eq. 5: sphere. Ize, JCGT 2(2) (2013):
//          slab test with a widened far side. Laine, HPG (2010): restart trail. Skilling, AIP Conf. Proc. 707 (2004):
//          Hilbert curve. Jarzynski and Olano, JCGT 9(3) (2020): pcg3d. Vogel, Math. Biosci. 44 (1979): phyllotaxis.
//          Born and Wolf, Principles of Optics, sec. 1.5: Fresnel. Amanatides, SIGGRAPH (1984): cone footprints.
// Units    1 unit = 1 m, y up, linear sRGB colour until the display curve; lamps in radiance x m^2.
// Passes   wood, places, ranks, tree: drawn once, they depend on tweaks at most. moving: 256 x 2 texels every frame.
// Bounds   llvmpipe ends all loops of a pixel after 65,535 turns together. The worst default, 4096 ornaments with
//          `none`, takes 16 spheres a turn: at most 8 rays x (256 + 3 x 256) turns = 8,192, far below.
// Licence  MIT

// ---- Tweaks ---------------------------------------------------------------------------------------------------------
//@ group Tree
uniform int   ornaments;       //@ 16 [16, 4096] log "spheres on the tree; 16 are three tiers, more fill a cone"
uniform float glass;           //@ 0.25 [0, 1] "share of the ornaments that are clear glass"
uniform float accents;         //@ 0.0 [0, 1] "share of the mirrors that are red or gold instead of green"
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
uniform float fillLight;       //@ 1.0 [0, 4] "light that reaches the circling balls and nothing else"
uniform int   shadows;         //@ 2 {off, hard, soft} "kind of shadow"
uniform float lampRadius;      //@ 0.2 [0, 1] unit=m "size of the lamps; larger is softer"
//@ group Camera
uniform float cameraDistance;  //@ 5.6 [3, 8.5] unit=m "from the tree's axis"
uniform float cameraAngle;     //@ 20 [-180, 180] unit=deg "round the tree"
uniform float cameraHeight;    //@ 1.0 [0.1, 6] unit=m "of the eye"
uniform float targetHeight;    //@ 1.75 [0, 4] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-2, 2] unit=m "of the point looked at, to the right"
uniform float focalLength;     //@ 28 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   acceleration;    //@ 2 {none, boxes, hierarchy} "how rays find the ornaments; the picture is the same"
uniform int   bounces;         //@ 6 [1, 8] quality reference=8 "rays along one path"
uniform float mirrorBlur;      //@ 0.6 [0.1, 100] log unit=rad quality reference=100 "footprint beyond which mirrors show a blur"
uniform int   shadowSamples;   //@ 1 [1, 16] log quality reference=16 "cones to each lamp"

precision highp sampler2D;   // the default is lowp, and then Mesa reads a buffer of 32-bit floats as halves
uniform sampler2D wood;            //@ pass mainWood size=512x1024 wrap=repeat filter=mipmap
uniform sampler2D ornamentPlaces;  //@ pass mainPlaces size=64x128
uniform sampler2D ornamentRanks;   //@ pass mainRanks size=64x64
uniform sampler2D ornamentTree;    //@ pass mainTree size=64x256
uniform sampler2D moving;          //@ pass mainMoving size=256x2

// ---- Constants ------------------------------------------------------------------------------------------------------
const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // 1 / golden ratio: turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kIorGlass = 1.52;              // crown glass, visible light
const float kIorVarnish = 1.5;
const float kLeastThroughput = 0.012;      // a path that carries less is over
const float kLeastLight = 0.02;            // what sees less of a lamp than this sees nothing, in whatever order it is hidden
const vec3  kRoom = vec3(9.0, 10.0, 9.0);  // m, half width, height, half depth
const float kTrunkHeight = 3.6, kTrunkHalf = 0.30, kCoreHalf = 0.46;    // m, the core carries a full cone
const float kConeHeight = 2.85, kConeRadius = 1.12, kConeApex = 3.6;    // m, the cone that many ornaments fill
const vec3  kStarCentre = vec3(0.0, 3.74, 0.0), kStarHalf = vec3(0.20, 0.27, 0.20);   // m
const vec3  kBodyCentre = vec3(1.75, 0.34, 0.75), kBodyHalf = vec3(0.42, 0.34, 0.42); // m
const vec3  kLidCentre = vec3(1.75, 0.70, 0.75), kLidHalf = vec3(0.47, 0.09, 0.47);   // m
const float kGiftTurn = 0.35;                                           // rad
const float kPlank = 0.16, kPlankLength = 2.6;                          // m
const vec2  kWoodTile = vec2(0.64, 5.0);                                // m, across and along the grain
const int   kBatch = 16;                   // spheres in one turn of the plain loop
const int   kRow = 64;                     // texels in a row of the ornament buffers
const float kBoxGrid = 1.0 / 1000.0;       // m, boxes of the hierarchy are rounded outwards to it
const vec3  kBoxOrigin = vec3(2.048, 0.1, 2.048);   // m
const int   kTreeSteps = 4096;             // cap for one walk; 4096 ornaments measured at under 300
const int   kFloor = 8000, kWall = 8001, kTrunk = 8002, kStar = 8003, kBody = 8004, kLid = 8005, kBall = 8010;

const vec3  kAim = vec3(0.15, 0.6, 0.3);    // m, where the lamps point
const float kSpotCore = 0.985, kSpotRim = 0.86;   // cosines, full light within and none without

struct Hit { float t; vec4 face; int id; };  // face: dot(xyz, p) = w, flat things only; id < 4096 is an ornament
struct Lamp { vec3 pos; vec3 power; };

// ---- Numbers --------------------------------------------------------------------------------------------------------
uvec3 hash3(ivec3 q) {
    uvec3 v = uvec3(q) * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; return v;
}
vec3 random3(ivec3 q) { return vec3(hash3(q) >> 8u) / 16777216.0; }

// Cycles since the start, modulo 1, of a motion whose frequency is rounded to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }

vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 linearColour(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }  // sRGB, fit to 1/500

// A start for a secondary ray: some 8 ulp along the normal from a point that lies on the surface.
vec3 liftOff(vec3 p, vec3 nor) { return p + nor * (1e-6 * max(maxComponent(abs(p)), 0.1)); }

// Reflected share of unpolarised light, exact; eta is the index beyond over the index before the surface.
float fresnel(float cosI, float eta) {
    float gg = (eta - 1.0) * (eta + 1.0) + cosI * cosI;
    if (gg <= 0.0) return 1.0;
    float g = sqrt(gg);
    float a = (g - cosI) / max(g + cosI, 1e-9);
    float b = (cosI * (g + cosI) - 1.0) / (cosI * (g - cosI) + 1.0);
    return min(0.5 * a * a * (1.0 + b * b), 1.0);
}

// ---- Geometry -------------------------------------------------------------------------------------------------------
float intersectSphere(vec3 ro, vec3 rd, vec3 c, float r) {          // |rd| = 1
    vec3 f = ro - c; float b = dot(f, rd); vec3 l = f - b * rd; float d = r * r - dot(l, l);
    if (d < 0.0) return -1.0;
    float s = sqrt(d); return -b - s > 0.0 ? -b - s : -b + s;
}

vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}
// Does the ray meet the box before tMax? Far side widened by 2 ulp (Ize 2013), so that rounding never loses a hit.
bool meetsBox(vec3 ro, vec3 inv, vec3 lo, vec3 hi, float tMax) {
    vec3 a = (lo - ro) * inv, b = (hi - ro) * inv;
    vec3 n = min(a, b), f = max(a, b);
    return max(max(n.x, n.y), max(n.z, 0.0)) <= min(min(f.x, f.y), min(f.z, tMax)) * 1.00000024;
}
// Clips a ray against dot(face.xyz, p) <= face.w moved out by widen * t: 0 for a ray, the slope of its rim for a cone.
void clipPlane(vec3 ro, vec3 rd, vec4 face, float widen, inout vec2 span, inout vec4 entry) {
    float speed = dot(face.xyz, rd) - widen;
    if (abs(speed) < 1e-20) speed = 1e-20;
    float t = (face.w - dot(face.xyz, ro)) / speed;
    if (speed > 0.0) span.y = min(span.y, t);
    else if (t > span.x) { span.x = t; entry = face; }
}
vec2 clipBox(vec3 ro, vec3 rd, vec3 halfSize, float widen, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    clipPlane(ro, rd, vec4(1, 0, 0, halfSize.x), widen, span, entry);
    clipPlane(ro, rd, vec4(-1, 0, 0, halfSize.x), widen, span, entry);
    clipPlane(ro, rd, vec4(0, 1, 0, halfSize.y), widen, span, entry);
    clipPlane(ro, rd, vec4(0, -1, 0, halfSize.y), widen, span, entry);
    clipPlane(ro, rd, vec4(0, 0, 1, halfSize.z), widen, span, entry);
    clipPlane(ro, rd, vec4(0, 0, -1, halfSize.z), widen, span, entry);
    return span;
}
vec2 clipTrunk(vec3 ro, vec3 rd, float widen, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    float wide = ornaments <= 16 ? kTrunkHalf : kCoreHalf;
    vec3 n = vec3(kTrunkHeight, wide, kTrunkHeight * wide) / length(vec2(kTrunkHeight, wide));
    clipPlane(ro, rd, vec4(n.x, n.y, 0.0, n.z), widen, span, entry);
    clipPlane(ro, rd, vec4(-n.x, n.y, 0.0, n.z), widen, span, entry);
    clipPlane(ro, rd, vec4(0.0, n.y, n.x, n.z), widen, span, entry);
    clipPlane(ro, rd, vec4(0.0, n.y, -n.x, n.z), widen, span, entry);
    return span;
}
vec2 clipStar(vec3 ro, vec3 rd, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    vec4 n = vec4(1.0 / kStarHalf, 1.0) / length(1.0 / kStarHalf);
    for (int k = 0; k < 8; ++k)
        clipPlane(ro, rd, n * vec4((k & 1) * 2 - 1, (k & 2) - 1, (k & 4) / 2 - 1, 1), 0.0, span, entry);
    return span;
}
vec3 toStar(vec3 v) { return vec3(turn(v.xz, 2.0 * kPi * cycles(0.0625)), v.y).xzy; }
vec3 fromStar(vec3 v) { return vec3(turn(v.xz, -2.0 * kPi * cycles(0.0625)), v.y).xzy; }
vec4 placed(vec3 nor, vec3 origin, float d) { return vec4(nor, d + dot(nor, origin)); }
vec3 toGift(vec3 v) { return vec3(turn(v.xz, kGiftTurn), v.y).xzy; }
vec3 fromGift(vec3 v) { return vec3(turn(v.xz, -kGiftTurn), v.y).xzy; }

// ---- Ornaments ------------------------------------------------------------------------------------------------------
vec4 texelOf(sampler2D buffer, int index, int row) {
    return texelFetch(buffer, ivec2(index & (kRow - 1), row + (index >> 6)), 0);
}
// Corners of a box from one texel: on each axis two whole numbers below 4096 share the 24 bits of a float.
void unpackBox(vec4 texel, out vec3 lo, out vec3 hi) {
    vec3 low = floor(texel.xyz / 4096.0);
    lo = low * kBoxGrid - kBoxOrigin;
    hi = (texel.xyz - low * 4096.0) * kBoxGrid - kBoxOrigin;
}
// Place on the curve of a leaf: leaf n is where the deepest row of the heap ends and the row above goes on.
int leafPlace(int leaf) {
    int deepest = 1 << ((floatBitsToInt(float(ornaments - 1)) >> 23) - 126);   // the power of two from n on
    return leaf >= deepest ? leaf - deepest : leaf + ornaments - deepest;
}
void meetOrnament(int id, vec4 s, vec3 ro, vec3 rd, inout Hit h) {
    float t = intersectSphere(ro, rd, s.xyz, abs(s.w));
    if (t > 0.0 && (t < h.t || (t == h.t && id < h.id))) { h.t = t; h.id = id; }   // no order of tests can matter
}
// Share of a lamp's disc that a sphere leaves free. The disc seen from ro has the slope `rim`; |rd| = 1, lamp at tMax.
float besideSphere(vec3 ro, vec3 rd, float rim, float tMax, vec4 s) {
    vec3 f = s.xyz - ro;
    float t = dot(f, rd), r = abs(s.w);
    float away = length(f - t * rd), disc = max(rim * t, 1e-6);
    float reach = smoothstep(0.0, 1.0, (r + disc - away) / (2.0 * min(r, disc)));
    float cover = t > 0.0 && t < tMax ? reach * min(1.0, square(r / disc)) : 0.0;
    return 1.0 - cover * (s.w < 0.0 ? 0.62 : 1.0);   // biased: glass dims light and does not focus it
}
// Next node after a subtree is done: up by every level whose second child is done, then across.
void nextNode(inout int node, inout int trail) {
    trail += 1;
    int up = (floatBitsToInt(float(trail & -trail)) >> 23) - 127;   // its trailing zeros
    trail >>= up;
    node = (node >> up) ^ 1;
}

void hitOrnaments(vec3 ro, vec3 rd, inout Hit h) {
    vec3 inv = safeInverse(rd);
    if (acceleration == 2) {
        int node = 1, trail = 1;
        for (int k = 0; k < kTreeSteps; ++k) {
            vec4 texel = texelOf(ornamentTree, node, 128);
            vec3 lo, hi;
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
        return;
    }
    int count = ornaments;
    if (acceleration == 1) {
        vec3 lo, hi;
        unpackBox(texelOf(ornamentTree, 1, 128), lo, hi);
        if (!meetsBox(ro, inv, lo, hi, h.t)) count = 0;
    }
    for (int k = 0; k < count; k += kBatch)
        for (int j = k; j < k + kBatch; ++j)
            if (j < ornaments) meetOrnament(j, texelOf(ornamentTree, j, 0), ro, rd, h);
}

float besideOrnaments(vec3 ro, vec3 rd, float rim, float tMax, float free) {
    vec3 inv = safeInverse(rd);
    if (acceleration == 2) {
        int node = 1, trail = 1;
        for (int k = 0; k < kTreeSteps && free > kLeastLight; ++k) {
            vec4 texel = texelOf(ornamentTree, node, 128);
            vec3 lo, hi;
            unpackBox(texel, lo, hi);
            float far = dot(max((lo - ro) * rd, (hi - ro) * rd), vec3(1.0)), grow = rim * far;   // far: the box's reach
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
    int count = ornaments;
    if (acceleration == 1) {
        float grow = rim * tMax;
        vec3 lo, hi;
        unpackBox(texelOf(ornamentTree, 1, 128), lo, hi);
        if (!meetsBox(ro, inv, lo - grow, hi + grow, tMax)) count = 0;
    }
    for (int k = 0; k < count; k += kBatch)
        for (int j = k; j < k + kBatch; ++j)
            if (j < ornaments) free *= besideSphere(ro, rd, rim, tMax, texelOf(ornamentTree, j, 0));
    return free;
}

// ---- Light ----------------------------------------------------------------------------------------------------------
Lamp lamp(int k) {
    if (k == 0) return Lamp(vec3(-3.4, 5.8, 5.0), 105.0 * lampPower * linearColour(keyColour));
    if (k == 1) return Lamp(vec3(4.5, 4.7, -3.3), 100.0 * lampPower * linearColour(roseColour));
    return Lamp(vec3(-4.6, 4.9, -3.6), 150.0 * lampPower * linearColour(coolColour));
}

// Share of the cone that a convex solid leaves free: where between its two rims the solid's outline crosses it.
// `inner` and `outer` are the gaps (entry minus exit) of the solid for the rays shrunk and widened to the rims.
float besideConvex(vec2 inner, vec2 outer) {
    float a = inner.x - inner.y, b = outer.x - outer.y;
    if (b >= 0.0) return 1.0;
    if (a <= 0.0) return 0.0;
    return smoothstep(0.0, 1.0, a / max(a - b, 1e-9));
}

// Share of one sub-disc of a lamp that a point sees.
float visibility(vec3 ro, vec3 rd, float rim, float tMax) {
    vec4 n;
    vec3 q = toGift(ro - kBodyCentre), qd = toGift(rd);
    float free = besideConvex(clipTrunk(ro, rd, -rim, tMax, n), clipTrunk(ro, rd, rim, tMax, n));
    free *= besideConvex(clipBox(q, qd, kBodyHalf, -rim, tMax, n), clipBox(q, qd, kBodyHalf, rim, tMax, n));
    q.y -= kLidCentre.y - kBodyCentre.y;
    free *= besideConvex(clipBox(q, qd, kLidHalf, -rim, tMax, n), clipBox(q, qd, kLidHalf, rim, tMax, n));
    for (int k = 0; k < orbitingBalls; ++k)
        free *= besideSphere(ro, rd, rim, tMax, texelFetch(moving, ivec2(k, 1), 0));
    free = besideOrnaments(ro, rd, rim, tMax, free);
    return max(free - kLeastLight, 0.0) / (1.0 - kLeastLight);
}

// Light that a matt surface sends on, for an albedo of 1.
vec3 irradiance(vec3 p, vec3 nor, bool fillLit, int lamps) {
    vec3 sum = vec3(0.0);
    for (int k = 0; k < lamps; ++k) {
        Lamp source = lamp(k);
        float size = shadows == 2 ? lampRadius / sqrt(float(shadowSamples)) : 0.0;
        vec3 axis = source.pos - p;
        float distance2 = dot(axis, axis), cosine = dot(axis, nor) * inversesqrt(distance2);
        float spot = smoothstep(kSpotRim, kSpotCore, dot(normalize(kAim - source.pos), -axis) * inversesqrt(distance2));
        if (cosine * spot <= 0.0) continue;
        vec3 u = normalize(cross(axis, vec3(0.0, 1.0, 0.013))), v = normalize(cross(u, axis));
        float seen = shadows == 0 ? 1.0 : 0.0;
        if (shadows > 0)
            for (int j = 0; j < shadowSamples; ++j) {
                float a = 2.0 * kPi * kGolden * float(j), r = sqrt((float(j) + 0.5) / float(shadowSamples));
                vec3 to = axis + (lampRadius - size) * float(shadows - 1) * r * (u * cos(a) + v * sin(a));
                float far = length(to);
                seen += visibility(liftOff(p, nor), to / far, size / far, far);
            }
        sum += source.power * spot * cosine * seen / (distance2 * (shadows > 0 ? float(shadowSamples) : 1.0));
    }
    // The string of lights as one warm core on the axis, the star above it: unshadowed, they surround what they light.
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
        sum += fillLight * (0.12 + 0.5 * max(dot(fill, nor) * inversesqrt(dot(fill, fill)), 0.0));
    }
    return sum;
}

// What glows along a ray before tMax: fairy lights, the star, and for mirrors the lamps. width is the footprint at 1 m.
vec3 glow(vec3 ro, vec3 rd, float tMax, float width, float width0, bool mirrored) {
    vec3 sum = vec3(0.0);
    vec3 inv = safeInverse(rd);
    int count = meetsBox(ro, inv, vec3(-1.7, 0.2, -1.7), vec3(1.7, 3.9, 1.7), tMax) ? fairyLights : 0;
    for (int k = 0; k < count; k += 4) for (int j = k; j < k + 4; ++j) {
        vec4 light = texelFetch(moving, ivec2(j, 0), 0);
        vec3 f = light.xyz - ro;
        float t = dot(f, rd);
        vec3 l = f - t * rd;
        float away2 = dot(l, l), seen = max(0.020, 1.2 * (width0 + width * t)), shrink = 1.0 / (seen * seen);
        float core = square(max(1.0 - away2 * shrink, 0.0)) * shrink, halo = max(1.0 - away2 * 16.0, 0.0);
        if (t > 0.0 && t < tMax + 0.02) sum += light.w * (0.005 * core + 0.06 * square(square(halo * halo)));
    }
    sum *= vec3(1.0, 0.60, 0.24);
    // The star: light scattered once by thin haze, the closed form of 1 / r^2 along the ray, and a cross as in a lens.
    vec3 f = kStarCentre - ro;
    float t = dot(f, rd);
    vec3 l = f - t * rd;
    float away2 = dot(l, l), away = sqrt(away2 + 0.02), across = length(l.xz);
    float haze = exp(-0.5 * away) * (atan((tMax - t) / away) + atan(t / away)) / away;
    float cross4 = exp(-4.0 * abs(l.y)) / (1.0 + square(across / 0.010)) + exp(-5.0 * across) / (1.0 + square(l.y / 0.010));
    float near = smoothstep(0.4, 0.0, away2) / (0.15 + 20.0 * away2);
    float ahead = t > 0.0 && t < tMax + 0.5 ? 1.0 : 0.0;
    sum += vec3(1.0, 0.56, 0.18) * (starGlow * (0.020 * haze + ahead * (0.8 * cross4 + 0.04 * near)));
    if (mirrored)
        for (int k = 0; k < 3; ++k) {
            Lamp source = lamp(k);
            vec3 g = source.pos - ro;
            float s = dot(g, rd);
            float d2 = max(dot(g, g) - s * s, 0.0) / square(0.30 + width0 + width * max(s, 0.0));
            if (s > 0.0 && s < tMax) sum += source.power * (0.11 * exp(-d2 * d2) + 0.003 / (1.0 + d2));
        }
    return sum;
}

// ---- Materials ------------------------------------------------------------------------------------------------------
// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}

// Colour of the floor and, by the way, the tilt of its planks. foot: footprint along x and z, m.
vec3 floorAlbedo(vec3 p, vec2 foot, inout vec3 nor) {
    float row = floor(p.x / kPlank);
    vec3 rowRandom = random3(ivec3(int(row), 7, 1));
    float along = p.z / kPlankLength + rowRandom.x;
    vec3 plank = random3(ivec3(int(row), int(floor(along)), 2));
    float distinct = clamp(1.5 - foot.x / kPlank, 0.0, 1.0) * clamp(1.5 - foot.y / kPlankLength, 0.0, 1.0);
    vec2 texels = foot / kWoodTile * vec2(512.0, 1024.0);
    float lod = log2(max(max(texels.x, texels.y), 1.0));
    vec4 grain = textureLod(wood, p.xz / kWoodTile + floor(plank.xy * 64.0) / 64.0, lod);
    float seam = max(lines(p.x / kPlank, 0.010, foot.x / kPlank), lines(along, 0.0007, foot.y / kPlankLength));
    vec3 tone = mix(vec3(0.16, 0.058, 0.017), vec3(0.62, 0.315, 0.110), grain.r);
    tone *= mix(1.0, 0.72 + 0.56 * plank.z, distinct) * (1.0 - 0.55 * grain.g) * (1.0 - 0.85 * seam);
    nor = normalize(vec3((plank.xy - 0.5) * 0.008 * distinct + (grain.b - 0.5) * 0.006 * vec2(1.0, 0.25), 1.0).xzy);
    return tone;
}

// One layer of stars in square cells: never smaller than the footprint w, dimmer instead, and even where cells blur.
vec3 starLayer(vec2 uv, float cell, float radius, float w, int seed) {
    vec2 c = floor(uv / cell);
    uvec3 bits = hash3(ivec3(ivec2(c), seed));
    vec3 a = vec3(bits & 65535u) / 65536.0, b = vec3(bits >> 16u) / 65536.0;
    vec2 d = uv / cell - c - 0.3 - 0.4 * a.xy;
    float r = radius * (0.5 + a.z), seen = min(max(r, 0.75 * w), 0.14 * cell);
    float shine = square(square(b.x * b.x * b.x)) * (0.75 + 0.25 * sin(2.0 * kPi * (b.y + cycles(0.125 + 0.25 * floor(b.z * 4.0)))));
    float disc = exp(-dot(d, d) * square(cell / seen)) * square(r / seen);
    vec3 tint = mix(vec3(0.65, 0.78, 1.0), vec3(1.0, 0.86, 0.66), b.z);
    return tint * shine * disc * clamp(2.0 - 3.0 * w / cell, 0.0, 1.0);
}

// Walls and sky: their own night blue, stars, a window and a doorway that stand behind the camera.
vec3 nightWall(vec3 p, vec3 nor, float w) {
    bool sky = nor.y < -0.5;
    vec2 uv = sky ? p.xz : vec2(abs(nor.x) > 0.5 ? p.z : p.x, p.y);
    int seed = sky ? 90 : 10 + int(nor.x * 2.0 + nor.z * 3.0 + 5.0) * 8;
    float up = sky ? 1.0 : clamp(p.y / kRoom.y, 0.0, 1.0), middle = exp(-0.03 * uv.x * uv.x);
    vec3 base = mix(vec3(0.0022, 0.0026, 0.011), vec3(0.018, 0.036, 0.17), smoothstep(0.0, 0.9, up));
    base = base * mix(0.45, 1.0, middle) * (1.0 + 0.15 * nor.x);   // walls differ a little: corners can be read
    if (sky) base += vec3(0.55, 0.85, 1.40) * exp(-0.05 * dot(uv - vec2(-1.5, 1.0), uv - vec2(-1.5, 1.0)));   // moonlight
    vec3 stars = starLayer(uv, 0.15, 0.005, w, seed) * 7.0 + starLayer(uv + 0.31, 0.60, 0.009, w, seed + 2) * 40.0
        + starLayer(uv + 0.17, 1.7, 0.012, w, seed + 4) * 60.0;
    vec3 sum = base + stars * mix(0.5, 1.0, up);
    float edge = 0.02 + w;
    if (nor.z < -0.5) {   // behind the camera: a tall window to a snowy night, six panes
        vec2 q = (p.xy - vec2(-3.4, 4.4)) / vec2(2.3, 3.2);
        vec2 inside = smoothstep(vec2(1.0), vec2(1.0 - edge), abs(q));
        vec2 bars = smoothstep(vec2(0.035), vec2(0.035 + edge), abs(vec2(q.x, abs(q.y) - 0.34)));
        sum += inside.x * inside.y * bars.x * bars.y * mix(vec3(0.55, 0.75, 1.2), vec3(0.9, 1.3, 2.4), 0.5 + 0.5 * q.y);
        vec2 d = (p.xy - vec2(4.2, 1.7)) / vec2(1.0, 1.75);   // and an open door to a lit hall
        inside = smoothstep(vec2(1.0), vec2(1.0 - edge), abs(d));
        sum += inside.x * inside.y * vec3(2.6, 1.15, 0.38) * (0.75 - 0.25 * d.y);
    }
    return sum * nightSky;
}

// Flakes on vertical cylinders round the tree: each is met twice, in front of the axis and behind it.
vec3 snowfall(vec3 ro, vec3 rd, float tMax, float pixel) {
    float a = dot(rd.xz, rd.xz), b = dot(ro.xz, rd.xz), c = dot(ro.xz, ro.xz), sum = 0.0;
    if (a < 1e-6) return vec3(0.0);
    for (int k = 0; k < 24; ++k) {
        float radius = 1.9 + 0.5 * float(k >> 1), disc = b * b - a * (c - radius * radius);
        float t = (-b + ((k & 1) == 0 ? -1.0 : 1.0) * sqrt(max(disc, 0.0))) / a;
        vec3 p = ro + t * rd;
        float columns = floor(2.0 * kPi * radius / 0.34);
        vec2 uv = vec2((atan(p.x, p.z + 1e-9) / (2.0 * kPi) + 0.5) * columns, p.y / 0.34);
        float rows = 32.0;   // cells before the fall repeats
        uv.y += rows * cycles(floor(65536.0 * snowSpeed * (0.8 + 0.04 * float(k >> 1)) / (0.34 * rows)) / 65536.0);
        vec2 cell = floor(uv);
        vec3 r = random3(ivec3(int(mod(cell.x + 0.5, columns)), int(mod(cell.y + 0.5, rows)), 200 + (k >> 1)));
        vec2 sway = 0.16 * sin(2.0 * kPi * (r.xy + vec2(cycles(0.1875), cycles(0.125))));
        vec2 d = (uv - cell - 0.5 - sway - (r.xy - 0.5) * 0.3) * 0.34;
        float size = mix(0.006, 0.016, r.z), seen = max(size, 0.8 * pixel * t);
        float flake = exp(-dot(d, d) / (seen * seen)) * square(size / seen);
        if (disc > 0.0 && t > 0.6 && t < tMax && fract(r.z * 97.0) < snow && p.y < kRoom.y) sum += flake;
    }
    return vec3(0.62, 0.72, 0.95) * sum;
}

// The room seen without detail: floor, horizon, night above.
vec3 surroundings(vec3 rd) {
    vec3 down = vec3(0.26, 0.10, 0.036) * lampPower, level = vec3(0.030, 0.028, 0.040), above = vec3(0.16, 0.25, 0.48) * nightSky;
    return mix(level, rd.y < 0.0 ? down : above, smoothstep(0.0, 0.8, abs(rd.y)));
}

Hit closestHit(vec3 ro, vec3 rd) {
    Hit h = Hit(kFar, vec4(0.0), kWall);
    hitOrnaments(ro, rd, h);
    for (int k = 0; k < orbitingBalls; ++k) {
        vec4 s = texelFetch(moving, ivec2(k, 1), 0);
        float t = intersectSphere(ro, rd, s.xyz, s.w);
        if (t > 0.0 && t < h.t) { h.t = t; h.id = kBall + k; }
    }
    vec4 n;
    vec2 span = clipTrunk(ro, rd, 0.0, h.t, n);
    if (span.x < span.y && span.x > 0.0) h = Hit(span.x, n, kTrunk);
    span = clipStar(toStar(ro - kStarCentre), toStar(rd), h.t, n);
    if (span.x < span.y && span.x > 0.0) h = Hit(span.x, placed(fromStar(n.xyz), kStarCentre, n.w), kStar);
    vec3 q = toGift(ro - kBodyCentre), qd = toGift(rd);
    span = clipBox(q, qd, kBodyHalf, 0.0, h.t, n);
    if (span.x < span.y && span.x > 0.0) h = Hit(span.x, placed(fromGift(n.xyz), kBodyCentre, n.w), kBody);
    q.y -= kLidCentre.y - kBodyCentre.y;
    span = clipBox(q, qd, kLidHalf, 0.0, h.t, n);
    if (span.x < span.y && span.x > 0.0) h = Hit(span.x, placed(fromGift(n.xyz), kLidCentre, n.w), kLid);
    // The room from inside: the nearest of the planes ahead.
    vec3 ahead = mix(-kRoom, kRoom, greaterThan(rd, vec3(0.0)));
    ahead.y = max(ahead.y, 0.0);
    vec3 far = max((ahead - ro) * safeInverse(rd), 0.0);
    float t = min(far.x, min(far.y, far.z));
    if (t < h.t) {
        vec3 axis = t == far.y ? vec3(0, 1, 0) : t == far.x ? vec3(1, 0, 0) : vec3(0, 0, 1);
        vec3 nor = dot(axis, rd) > 0.0 ? -axis : axis;
        h = Hit(t, vec4(nor, dot(nor, ahead * axis)), nor.y > 0.5 ? kFloor : kWall);
    }
    return h;
}

// Light that arrives at ro against rd. pixel: angle of a pixel, rad.
vec3 radiance(vec3 ro, vec3 rd, float pixel) {
    vec3 sum = vec3(0.0), throughput = vec3(1.0);
    vec3 laterRo = ro, laterRd = rd, laterThroughput = vec3(0.0);   // the queue's one place
    float width0 = 0.0, width = pixel, laterWidth0 = 0.0, laterWidth = pixel;
    for (int ray = 0; ray < bounces; ++ray) {
        Hit h = closestHit(ro, rd);
        vec3 p = ro + h.t * rd, nor = h.face.xyz;
        vec4 ball = vec4(0.0);
        if (h.id < kFloor) ball = texelOf(ornamentTree, h.id, 0);
        if (h.id >= kBall) ball = texelFetch(moving, ivec2(h.id - kBall, 1), 0);
        if (ball.w != 0.0) {   // back onto the surface: nothing a ray starts from is off by its length's rounding
            nor = normalize(p - ball.xyz);
            p = ball.xyz + abs(ball.w) * nor;
        } else {
            p -= (dot(nor, p) - h.face.w) * nor;
        }
        vec3 facing = nor;
        float w = width0 + width * h.t, cosine = clamp(-dot(rd, nor), 0.0, 1.0);
        vec3 shine = glow(ro, rd, h.t, width, width0, ray > 0);
        if (snow > 0.0 && ray == 0) shine += snowfall(ro, rd, h.t, pixel);
        vec3 mirror = vec3(0.0), albedo = vec3(0.0);
        bool glassy = false;
        if (h.id == kWall) {
            shine += nightWall(p, nor, w / max(cosine, 0.2));
        } else if (h.id == kFloor) {
            vec2 slope = rd.xz / max(-rd.y, 1e-4);
            albedo = floorAlbedo(p, min(w * sqrt(1.0 + slope * slope), vec2(20.0)), nor);
            mirror = vec3(floorGloss * fresnel(clamp(-dot(rd, nor), 0.0, 1.0), kIorVarnish));
        } else if (h.id < kFloor) {
            vec3 tint = texelOf(ornamentTree, h.id, 64).rgb;
            glassy = ball.w < 0.0;
            mirror = mix(tint, vec3(1.0), pow(1.0 - cosine, 5.0));
            width += 2.0 * w / (abs(ball.w) * max(cosine, 0.04));
            if (glassy) mirror = vec3(fresnel(cosine, kIorGlass));
        } else if (h.id >= kBall) {
            albedo = (h.id & 1) == 0 ? vec3(0.85, 0.52, 0.02) : vec3(0.62, 0.012, 0.02);
            mirror = vec3(fresnel(cosine, kIorVarnish));
            width += 20.0 * w;
        } else if (h.id == kTrunk) {
            albedo = vec3(0.30, 0.17, 0.06);
            mirror = mix(vec3(0.42, 0.27, 0.11), vec3(1.0), pow(1.0 - cosine, 5.0));
        } else if (h.id == kStar) {
            shine += vec3(1.0, 0.50, 0.09) * (starGlow * (0.35 + 1.9 * cosine * cosine));
            mirror = 0.5 * mix(vec3(0.9, 0.62, 0.22), vec3(1.0), pow(1.0 - cosine, 5.0));
        } else {
            vec3 q = toGift(p - kBodyCentre), face = abs(toGift(nor));
            float band = face.x > 0.5 ? abs(q.z) : face.z > 0.5 ? abs(q.x) : min(abs(q.x), abs(q.z));
            float ribbon = 1.0 - smoothstep(0.075 - 0.5 * w, 0.075 + 0.5 * w + 1e-4, band);
            albedo = mix(vec3(0.58, 0.010, 0.016), vec3(0.86, 0.60, 0.06), h.id == kLid ? 1.0 - ribbon : ribbon);
            mirror = vec3(fresnel(cosine, kIorVarnish));
        }
        sum += throughput * shine;
        int lamps = maxComponent(throughput * albedo) > kLeastThroughput ? 3 : 0;   // a loop, so that SIMD can skip it
        sum += throughput * (1.0 - mirror) * albedo * irradiance(p, facing, h.id >= kBall, lamps);
        ro = liftOff(p, facing);
        vec3 reflected = reflect(rd, nor);
        reflected = normalize(reflected + max(1e-4 - dot(reflected, facing), 0.0) * facing);   // above the surface
        if (glassy) {
            if (maxComponent(throughput) * mirror.x > maxComponent(laterThroughput)) {
                laterRo = ro; laterRd = reflected; laterThroughput = throughput * mirror;
                laterWidth0 = w; laterWidth = width;
            }
            float r = abs(ball.w), eta = 1.0 / kIorGlass, cosI = cosine;
            vec3 n = nor;
            rd = normalize(eta * rd + (eta * cosI - sqrt((1.0 - eta) * (1.0 + eta) + square(eta * cosI))) * n);
            throughput *= 1.0 - mirror;
            for (int k = 0; k < 3; ++k) {   // chords; biased: what leaves by later ones is left out, but for total reflection
                float chord = -2.0 * r * min(dot(n, rd), 0.0);
                n = normalize(r * n + chord * rd);
                throughput *= exp(-chord * vec3(0.16, 0.06, 0.10));   // 1/m, a breath of green in thick glass
                float cosO = clamp(dot(n, rd), 0.0, 1.0), k2 = (1.0 - kIorGlass) * (1.0 + kIorGlass) + square(kIorGlass * cosO);
                if (k2 <= 0.0) { rd = normalize(reflect(rd, n)); continue; }   // total reflection
                throughput *= 1.0 - fresnel(cosO, 1.0 / kIorGlass);
                rd = normalize(kIorGlass * rd - (kIorGlass * cosO - sqrt(k2)) * n);
                break;
            }
            ro = liftOff(ball.xyz + r * n, n);
        } else {
            throughput *= mirror;
            rd = reflected;
        }
        width0 = w;
        if (width > mirrorBlur) {   // biased: the surroundings stand for what so wide a cone would gather
            sum += throughput * surroundings(rd);
            throughput = vec3(0.0);
        }
        if (maxComponent(throughput) < kLeastThroughput) {
            if (maxComponent(laterThroughput) < kLeastThroughput) break;
            ro = laterRo; rd = laterRd; throughput = laterThroughput; width0 = laterWidth0; width = laterWidth;
            laterThroughput = vec3(0.0);
        }
    }
    return sum;
}

// ---- Passes ---------------------------------------------------------------------------------------------------------
float tiledNoise(vec2 p, ivec2 period, int seed) {   // value noise on a torus
    ivec2 c = ivec2(floor(p));
    vec2 f = p - vec2(c), s = f * f * (3.0 - 2.0 * f);
    ivec2 a = c - period * ivec2(floor(vec2(c) / vec2(period))), b = ivec2((a.x + 1) % period.x, (a.y + 1) % period.y);
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}

// Grain: r tone, g dark pores, b waviness of the varnish. One tile is kWoodTile; it repeats without a seam.
void mainWood(out vec4 colour, in vec2 pixel) {
    vec2 p = pixel / vec2(512.0, 1024.0);
    float bend = tiledNoise(p * vec2(6, 5), ivec2(6, 5), 1) + 0.5 * tiledNoise(p * vec2(12, 13), ivec2(12, 13), 2);
    float rings = 0.5 + 0.5 * sin(2.0 * kPi * (10.0 * p.x + 2.2 * bend));
    float streak = tiledNoise(p * vec2(90, 7), ivec2(90, 7), 3), fibre = tiledNoise(p * vec2(230, 22), ivec2(230, 22), 4);
    float pores = smoothstep(0.72, 0.95, tiledNoise(p * vec2(256, 60), ivec2(256, 60), 5)) * (0.35 + 0.65 * rings);
    float tone = clamp(0.12 + 0.30 * rings * rings + 0.32 * streak + 0.22 * fibre + 0.2 * (bend - 0.75), 0.0, 1.0);
    colour = vec4(tone, pores, tiledNoise(p * vec2(24, 40), ivec2(24, 40), 6), 1.0);
}

// Index along a Hilbert curve of 2^8 cells a side (Skilling 2004): neighbours on the curve are neighbours in space.
float hilbertIndex(uvec3 x) {
    for (uint q = 128u; q > 1u; q >>= 1u) {
        uint mask = q - 1u;
        for (int i = 0; i < 3; ++i) {
            uint t = (x[i] & q) != 0u ? 0u : (x.x ^ x[i]) & mask;
            if ((x[i] & q) != 0u) x.x ^= mask;
            x.x ^= t;
            if (i > 0) x[i] ^= t;
            else if (t != 0u) x.x ^= 0u;
        }
    }
    x.y ^= x.x;
    x.z ^= x.y;
    uint t = 0u;
    for (uint q = 128u; q > 1u; q >>= 1u)
        if ((x.z & q) != 0u) t ^= q - 1u;
    x ^= uvec3(t);
    uint index = 0u;
    for (uint b = 8u; b > 0u; --b) {
        uvec3 bit = (x >> (b - 1u)) & 1u;
        index = index * 8u + bit.x * 4u + bit.y * 2u + bit.z;
    }
    return float(index);   // 24 bits: exact
}

// Ornament i by its formula: centre and radius. Tiers for 16, else a phyllotaxis on one or two nested cones.
vec4 placeOrnament(int i) {
    if (ornaments <= 16) {
        int tier = i < 6 ? 0 : i < 11 ? 1 : 2;
        float k = float(tier == 0 ? i : tier == 1 ? i - 6 : i - 11), count = tier == 0 ? 6.0 : 5.0;
        vec3 shape = tier == 0 ? vec3(0.93, 1.16, 0.41) : tier == 1 ? vec3(0.70, 2.08, 0.30) : vec3(0.44, 2.86, 0.19);
        float a = 2.0 * kPi * (k + 0.35 * float(tier)) / count;
        return vec4(shape.x * sin(a), shape.y, shape.x * cos(a), shape.z);
    }
    float index = float(i), inner = ornaments < 500 ? 0.0 : 0.78;   // the second shell's scale
    float outside = floor(float(ornaments) / (1.0 + inner * inner) + 0.5), shell = step(outside, index);
    float first = shell * outside, count = mix(outside, float(ornaments) - outside, shell), size = mix(1.0, inner, shell);
    float s = mix(0.10, 1.0, (index - first + 0.5) / count);   // 0 at the apex, 1 at the rim
    float a = 2.0 * kPi * fract((index - first) * kGolden + 0.37 * shell);
    // The lattice's least gap is 0.87 of the root of the area per point; near the apex the core is the limit.
    float spacing = sqrt(2.0 * kPi * s * kConeRadius * length(vec2(kConeHeight, kConeRadius)) * size * size / count);
    float r = min(0.43 * spacing * mix(0.74, 1.0, random3(ivec3(i, 3, 5)).x), min(0.42 * s * size, 0.30));
    float ring = kConeRadius * size * s;
    return vec4(ring * sin(a), kConeApex - kConeHeight * s * mix(1.0, size, 0.4), ring * cos(a), r);
}

void mainPlaces(out vec4 colour, in vec2 pixel) {
    int row = int(pixel.y), i = int(pixel.x) + kRow * (row & 63);
    vec4 s = placeOrnament(i);
    vec3 r = random3(ivec3(i, 11, 3));
    if (row < 64) {
        bool isGlass = fract((float(i) + 0.5) * kGolden + 0.17) < glass;
        colour = vec4(s.xyz, isGlass ? -s.w : s.w);
        return;
    }
    vec3 tint = linearColour(ornamentTint) * mix(0.75, 1.25, r.z);
    float lane = ornaments <= 16 ? r.x : fract(float(i % 21) / 21.0 + 0.3);   // every 21st: spirals on the cone
    if (lane < accents) tint = lane < 0.6 * accents ? vec3(0.86, 0.54, 0.16) : vec3(0.66, 0.035, 0.045);
    colour = vec4(min(tint, 1.0), hilbertIndex(uvec3(clamp((s.xyz + vec3(2, 0, 2)) * 64.0, 0.0, 255.0))));
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

// Rows 0-63 spheres in Hilbert order, 64-127 their colours, 128-255 a heap of 2n - 1 nodes: the spheres again as leaves,
// above them boxes with, as fourth number, the axis along which the children lie (1 to 3), negative if downwards.
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
        float twinkle = 0.8 + 0.2 * sin(2.0 * kPi * (r.y + cycles(0.25 + 0.125 * floor(r.z * 5.0))));
        float s = sqrt(mix(0.02, 1.0, share)), a = 14.0 * kPi * s, radius = mix(0.10, 1.24, s), y = 3.45 - 2.85 * s;
        if (ornaments <= 16) {   // four rings in the gaps between the tiers, joined where one steps down to the next
            float along = share * 2.96;
            vec4 ring = along < 0.22 ? vec4(0.22, 3.24, 0.60, 2.50) : along < 0.82 ? vec4(0.60, 2.50, 0.92, 1.67)
                : along < 1.74 ? vec4(0.92, 1.67, 1.22, 0.64) : vec4(1.22, 0.64, 1.22, 0.64);
            float round = (along - (along < 0.22 ? 0.0 : along < 0.82 ? 0.22 : along < 1.74 ? 0.82 : 1.74)) / ring.x;
            vec2 here = mix(ring.xy, ring.zw, smoothstep(0.86, 1.0, round));
            a = 2.0 * kPi * round;
            radius = here.x;
            y = here.y;
        }
        colour = vec4(radius * sin(a), y + 0.03 * (r.z - 0.5), radius * cos(a), twinkle * fairyGlow);
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

// ---- Image ----------------------------------------------------------------------------------------------------------
// Light to display: clamped first, then the largest channel is rolled off and the others keep their ratio to it, with
// a little white towards the top as on film; sRGB at the end. In [0, 1], monotone; NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 orbit = iMouse.xy == vec2(0.0) ? vec2(0.0) : iMouse.xy / iResolution.xy - 0.5;   // dragged: round the tree
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
    fragColor = vec4(display(exp2(exposure) * radiance(ro, rd, 1.0 / (lens * iResolution.y))), 1.0);
}
