// Magic: golden bipyramids, spheres of blue mirror and of glass, in a dark hall.
//
// Three bipyramids float and turn above a glossy violet floor. Mirrors and glass balls rise and
// fall round them, small cubes and fill-lit golden balls go round on orbits, and a red, a blue and
// a violet lamp wander in thin haze: coloured shadows cross, light gathers under the glass.
//
// Method   A tree of mirrored and refracted rays, brightest first; one waits. Shadows
//          are cones to `shadowSamples` sub-discs of a lamp: the share of a sub-disc that one
//          occluder hides has a closed form, several multiply; smooth with one cone, exact in the
//          limit of many. A light buffer names the few things that can shade a direction from a
//          lamp. Polyhedra are triangles found by clipping the ray with half-spaces: neighbours
//          share plane equations, so no edge can leak. Glow is single scattering of a point light;
//          with t = h tan(x) the 1/d^2 is gone and `glowSamples` midpoints do. Light through a
//          glass ball: a ring of parallel rays meets it at impact parameter b, leaves with the same
//          b turned by 2 (asin b - asin(b/n)) and lands on a ring; rings smeared by the lamp's disc
//          sum to a table of the gain over unobstructed light. z -> z / (1 + z/S), which keeps
//          lines straight, sends a lamp at distance S to infinity. Traced photons agree within 3 %
//          (root mean square) from 1.5 m on and 20 % in the focus; 98 % of the energy is kept.
// Sources  Haines, Guenther, Akenine-Moeller, Ray Tracing Gems ch. 7 (2019), eq. 5: sphere. Ize,
//          JCGT 2(2) (2013): slab test. Haines and Greenberg, IEEE CG&A 6(9) (1986): light buffer.
//          Jarzynski and Olano, JCGT 9(3) (2020): pcg3d. Born and Wolf, Principles of Optics, 1.5:
//          Fresnel. Kulla and Fajardo, CGF 31(4) (2012): equi-angular points. Kelemen and
//          Szirmay-Kalos, Eurographics (2001): sheen. Amanatides, SIGGRAPH (1984): footprints.
// Units    1 unit = 1 m, y up, linear sRGB colour until the display curve; lamps: radiance x m^2.
// Passes   gain: on change of a tweak. things, shadowers: every frame, tiny.
// Apart    Nothing can collide. A bipyramid keeps its own upright axis, all within 2.6 m of the
//          hall's. Spheres rise on uprights at 3.9 m, half a metre wide. The rest lives on two
//          round shells of 2.95 m and 4.95 m, each on one closed wavy curve shifted up by whole
//          steps: bodies there stay a step apart times the cosine of the wave's slope, whatever
//          their phase: 0.62 m, and need 0.56 m. Lamps stay beyond 5.5 m or above 7.9 m, all else
//          below 7.0 m; cameras stay beyond 8 m.
// Defaults From `glint study presets/magic.toml`, all on its frontier: 6 bounces are 0.003 (RMSE)
//          from 24; hard shadows are 0.008 from soft ones, one cone is 0.004 from 64 samples; 2
//          glowSamples are 2e-4 from 32.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Things
uniform int   spheres;         //@ 6 [0, 12] "spheres that rise and fall"
uniform float glass;           //@ 0.34 [0, 1] "share of the spheres that are clear glass"
uniform vec3  mirrorTint;      //@ #8fb0ff "colour of the mirror spheres"
uniform vec3  glassTint;       //@ #dfeaff "what a metre of glass lets through"
uniform float glassIndex;      //@ 1.5 [1.1, 2.4] "refractive index"
uniform int   bipyramids;      //@ 0 {gold, crystal} "what they are made of"
uniform vec3  gold;            //@ #ffc440 "colour of bipyramids and balls"
uniform int   cubes;           //@ 8 [0, 12] "tiny cubes on orbits"
uniform float glassCubes;      //@ 0.5 [0, 1] "share of the cubes that are glass"
uniform int   balls;           //@ 4 [0, 6] "fill-lit golden balls on orbits"
uniform float animation;       //@ 1.0 [0, 8] "speed of everything that moves"
//@ group Floor
uniform vec3  floorColour;     //@ #8c84ff "of the stone"
uniform float gloss;           //@ 1.0 [0, 1] "polish: 0 is bare stone"
uniform float pattern;         //@ 1.0 [0, 1] "tone between tiles, and inlays"
//@ group Light
uniform vec3  redColour;       //@ #ff4460 "lamp near the floor"
uniform vec3  blueColour;      //@ #3c68ff "lamp at the height of the spheres"
uniform vec3  violetColour;    //@ #b493ff "lamp above everything"
uniform float lampPower;       //@ 1.0 [0, 4] "brightness of the three lamps"
uniform float lampRadius;      //@ 0.18 [0.02, 0.5] unit=m "size of the lamps; larger is softer"
uniform float lampSpeed;       //@ 1.0 [0, 8] "how fast the lamps wander"
uniform float fillLight;       //@ 1.0 [0, 4] "reaches what is golden and nothing else"
uniform float haze;            //@ 0.0025 [0, 0.1] unit=1/m "scatters light: the glow of the lamps"
uniform bool  shafts;          //@ off "things cast shadows in the haze; wants 8 glowSamples"
uniform float hallLight;       //@ 1.0 [0, 4] "niches in the wall"
uniform int   shadows;         //@ 2 {off, hard, soft, sampled} quality reference=2 "kind of shadow"
uniform bool  caustics;        //@ on "light that glass gathers"
//@ group Camera
uniform float cameraDistance;  //@ 9.5 [8, 20] unit=m "from the hall's axis"
uniform float cameraAngle;     //@ -15 [-180, 180] unit=deg "round the hall"
uniform float cameraHeight;    //@ 1.9 [0.1, 12] unit=m "of the eye"
uniform float targetHeight;    //@ 2.2 [0, 6] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-5, 5] unit=m "of the point looked at, to the right"
uniform float focalLength;     //@ 21 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   bounces;         //@ 8 [1, 24] quality reference=24 "rays followed for a pixel"
uniform int   shadowSamples; //@ 1 [1, 64] log quality reference=64 second=shadows=sampled "cones to each lamp"
uniform int   glowSamples;     //@ 2 [1, 32] log quality reference=32 "points along a ray's glow"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D gain;            //@ pass mainGain size=128x64 format=r32f
uniform sampler2D things;          //@ pass mainThings size=48x2 filter=nearest
uniform sampler2D directions;      //@ pass mainDirections size=64x320 filter=nearest

// ---- Constants and numbers ----------------------------------------------------------------------
// Sizes and orbits keep all things apart (see Apart above). What moves is known by a number, its
// column in the buffer `things`: balls below kBalls, fill-lit ones below kCubes, then solids,
// lamps.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kIorVarnish = 1.62;            // hard lacquer
const float kIorStone = 1.9;              // polished floor
const float kLeastThroughput = 0.01;       // a ray that carries less is not followed
const float kSphereRing = 3.9, kSphereRadius = 0.49;     // m
const float kBallRadius = 0.25, kCubeHalf = 0.16;        // m
const vec2  kBipyramidHalf = vec2(0.62, 1.08);           // m, to the corners: across, up
const float kInnerShell = 2.95, kOuterShell = 4.95, kStep = 0.64;    // m
const vec3  kBoundLow = vec3(-5.3, 0.0, -5.3), kBoundHigh = vec3(5.3, 7.0, 5.3);   // m, all things
const vec3  kHazeTint = vec3(0.5, 0.62, 1.0);           // fine dust scatters blue
const float kHallRadius = 27.0;            // m
const float kHallHeight = 15.0;            // m
const float kNiches = 18.0;
const float kRise[6] = float[6](0.421, 0.012, 0.039, 0.571, 0.378, 0.891);   // cycles at time 0
const float kRays = 48.0;                  // of the floor's compass rose
const float kTile = 1.2;                   // m, between parallel joints of the floor
const vec2  kGainSize = vec2(128.0, 64.0); // texels
const float kGainTan = 1.0;               // the last tangent in the table
const int   kRings = 256;                  // rings of light through a glass ball
const int   kBalls = 12, kCubes = 20, kBipyramids = 32, kLamps = 35;   // columns of `things`
const int   kCells = 64;                   // of an octahedral map, along a side
const int   kEye = 3, kEyeMirrored = 4, kNowhere = 5;   // maps after those of the lamps
const int   kFloor = 40, kWall = 41, kCeiling = 42;

struct Hit { float t; vec4 face; int id; };   // face: dot(xyz, p) = w, for what is flat
struct Ray {
    vec3 ro, rd, weight;
    float width0, width;   // footprint at the start, and what it gains a metre
    int inside;            // the solid that it runs through, or -1
    int map;               // of directions, that its line starts from
};

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
// A texel of a buffer that `filter=nearest` reads, whatever its size: on the site all are as large
// as the picture. Cheaper than texelFetch on llvmpipe.
vec4 texelAt(sampler2D buffer, vec2 place) {
    return textureLod(buffer, (place + 0.5) / vec2(textureSize(buffer, 0)), 0.0);
}

// Cycles since the start, modulo 1, of a motion; its frequency is cut to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }
// 0, which compilers cannot know: a loop that starts there is not unrolled, and compiled sooner.
int loopStart() { return min(0, int(iSampleRate)); }

// A number from 0 to 1 for each pixel, nearly evenly apart among those of every square of 2, 4, 8
// ... pixels: quarters of quarters in an order by chance (Ahmed and Wonka, ACM TOG 39(6), 2020).
// What it leaves of an error is the finest grain, and no net as of a lattice.
float shuffledQuarters(ivec2 p) {
    float sum = 0.0, part = 0.25;
    for (int k = loopStart(); k < 6; ++k) {
        uvec3 r = hash3(ivec3(p >> 1, 60 + k)) >> 8u;   // one of the 24 orders of four
        int a = p.x & 1, b = p.y & 1, kind = int(r.x % 3u);
        int high = kind == 0 ? a : kind == 1 ? b : a ^ b, low = kind == 0 ? b : a;
        if ((r.y & 1u) == 1u) low ^= high;
        sum += part * float((2 * high + low) ^ int(r.z & 3u));
        part *= 0.25;
        p >>= 1;
    }
    return sum;
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

int lowestBit(int mask) { return (floatBitsToInt(float(mask & -mask)) >> 23) - 127; }
vec3 spun(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec3 unspun(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) - q.w * v); }
vec4 thing(int id) { return texelAt(things, vec2(id, 0)); }
vec4 attitude(int id) { return texelAt(things, vec2(id, 1)); }

// ---- Geometry -----------------------------------------------------------------------------------
// A convex solid is where all its half-spaces dot(n, p) <= d overlap, so what a ray has in common
// with it is one span [enter, leave]: each half-space cuts the span at t = (d - n.ro) / (n.rd), the
// front if the ray runs into it, the back if it runs out (Cyrus and Beck, 1978). An edge is where
// two cuts change places in a maximum: no gap between faces, as there is none between numbers.

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
// Does a cone of radius rim * t come near a ball before tMax?
bool meetsBall(vec3 ro, vec3 rd, vec3 centre, float radius, float rim, float tMax) {
    vec3 f = centre - ro;
    float t = dot(f, rd), reach = radius + rim * max(t, 0.0);
    return t > -radius && t < tMax + radius && dot(f, f) - t * t < reach * reach;
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
vec3 bipyramidNormal() {
    vec2 n = normalize(kBipyramidHalf.yx);
    return vec3(n, n.x) / length(vec3(n, n.x));
}
vec2 clipBipyramid(vec3 ro, vec3 rd, float widen, float tMax, out vec4 entry) {
    vec2 span = vec2(0.0, tMax);
    entry = vec4(0.0);
    vec3 n = bipyramidNormal();
    float d = n.y * kBipyramidHalf.y;
    clipPair(ro, rd, n, d, widen, span, entry);
    clipPair(ro, rd, n * vec3(-1, 1, 1), d, widen, span, entry);
    clipPair(ro, rd, n * vec3(1, -1, 1), d, widen, span, entry);
    clipPair(ro, rd, n * vec3(1, 1, -1), d, widen, span, entry);
    return span;
}
vec2 clipSolid(int id, vec3 ro, vec3 rd, float widen, float tMax, out vec4 entry) {
    return id >= kBipyramids ? clipBipyramid(ro, rd, widen, tMax, entry)
        : clipBox(ro, rd, vec3(kCubeHalf), widen, tMax, entry);
}
float boundOf(int id) { return id >= kBipyramids ? kBipyramidHalf.y : 1.7321 * kCubeHalf; }

// From inside a convex solid: the distance to its skin and the outward normal there.
float leaveSolid(int id, inout vec3 p, vec3 rd, out vec3 nor) {
    vec4 c = thing(id);
    if (id < kCubes) {
        float t = max(intersectSphere(p, rd, c.xyz, abs(c.w)), 0.0);
        nor = normalize(p + t * rd - c.xyz);
        p = c.xyz + abs(c.w) * nor;
        return t;
    }
    vec4 spin = attitude(id), entry;   // backwards from beyond: where that ray enters, ours leaves
    vec3 q = unspun(p - c.xyz, spin), qd = unspun(rd, spin);
    float beyond = 4.0 * boundOf(id);
    vec2 span = clipSolid(id, q + beyond * qd, -qd, 0.0, 2.0 * beyond, entry);
    float t = max(beyond - span.x, 0.0);
    q += t * qd;
    q -= (dot(entry.xyz, q) - entry.w) * entry.xyz;
    nor = spun(entry.xyz, spin);
    p = c.xyz + spun(q, spin);
    return t;
}

void meetSolid(int id, vec3 ro, vec3 rd, inout Hit h) {
    vec4 c = thing(id), n;
    if (!meetsBall(ro, rd, c.xyz, boundOf(id), 0.0, h.t)) return;
    vec4 spin = attitude(id);
    vec2 span = clipSolid(id, unspun(ro - c.xyz, spin), unspun(rd, spin), 0.0, h.t, n);
    if (span.x < span.y && span.x > 0.0) {
        vec3 nor = spun(n.xyz, spin);
        h = Hit(span.x, vec4(nor, n.w + dot(nor, c.xyz)), id);
    }
}
void meetRound(int id, vec3 ro, vec3 rd, inout Hit h) {
    vec4 s = thing(id);
    float t = intersectSphere(ro, rd, s.xyz, abs(s.w));
    if (t > 0.0 && t < h.t) {
        h.t = t;
        h.id = id;
    }
}

// What a ray can meet that starts at, or ends in, the middle of a map: bits of round things, of
// solids, and of glass balls that cast light its way. From nowhere, all that is there.
ivec3 metTowards(int map, vec3 d) {
    vec2 p = d.xz / (abs(d.x) + abs(d.y) + abs(d.z));
    if (d.y < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThan(p, vec2(0.0)));
    ivec2 cell = clamp(ivec2((0.5 + 0.5 * p) * float(kCells)), 0, kCells - 1);
    if (map == kNowhere) return ivec3(((1 << balls) - 1) << kBalls | ((1 << spheres) - 1),
                                      ((1 << cubes) - 1) | 7 << (kBipyramids - kCubes), 0);
    return ivec3(texelAt(directions, vec2(cell.x, cell.y + map * kCells)).xyz);
}

Hit intersect(vec3 ro, vec3 rd, int map) {
    // The wall is a cylinder seen from inside, the ceiling and the floor cut it off.
    float a = max(dot(rd.xz, rd.xz), 1e-6), b = dot(ro.xz, rd.xz);
    float c = min(dot(ro.xz, ro.xz) - square(kHallRadius), 0.0);
    float t = (sqrt(b * b - a * c) - b) / a;
    vec2 w = normalize(ro.xz + t * rd.xz + vec2(1e-9, 0.0));
    Hit h = Hit(t, vec4(-w.x, 0.0, -w.y, -kHallRadius), kWall);
    float down = -ro.y / min(rd.y, -1e-9), up = (kHallHeight - ro.y) / max(rd.y, 1e-9);
    if (rd.y < 0.0 && down < h.t) h = Hit(down, vec4(0, 1, 0, 0), kFloor);
    if (rd.y > 0.0 && up < h.t) h = Hit(up, vec4(0, -1, 0, -kHallHeight), kCeiling);
    if (!meetsBox(ro, safeInverse(rd), kBoundLow, kBoundHigh, h.t)) return h;
    ivec3 masks = metTowards(map, rd);
    for (int m = masks.x; m != 0; m &= m - 1) meetRound(lowestBit(m), ro, rd, h);
    for (int m = masks.y; m != 0; m &= m - 1) meetSolid(kCubes + lowestBit(m), ro, rd, h);
    return h;
}

// ---- Light --------------------------------------------------------------------------------------
// A lamp of radius R at distance d is seen under a cone of slope R / d. What one thing hides of the
// cone has a closed form; what several hide is taken to be independent: their free shares multiply.
// That is right where one thing stands alone, or outlines cross at random. Biased: two things in
// line hide the same part, and the product hides more (too dark); two side by side hide parts that
// add up, and the product hides less (too light). Many thin cones make it exact, since each sees
// one thing or none. Light itself is radiance = power * cosine / d^2 (1/m^2), for a surface of
// albedo 1.

vec3 lampLight(int k) {
    return lampPower * (k == 0 ? 36.0 * linearColour(redColour)
        : k == 1 ? 130.0 * linearColour(blueColour) : 190.0 * linearColour(violetColour));
}

// Share of a cone that a convex solid leaves free: where between the cone's rims its outline lies,
// from the spans of the cone's axis against the solid shrunk and widened by the cone.
float besideConvex(vec2 inner, vec2 outer) {
    float a = inner.x - inner.y, b = outer.x - outer.y;
    if (b >= 0.0) return 1.0;
    if (a <= 0.0) return 0.0;
    return smoothstep(0.0, 1.0, a / max(a - b, 1e-9));
}
float besideSolid(int id, vec3 ro, vec3 rd, float rim, float tMax) {
    vec4 c = thing(id), n;
    if (!meetsBall(ro, rd, c.xyz, boundOf(id), rim, tMax)) return 1.0;
    vec4 spin = attitude(id);
    vec3 q = unspun(ro - c.xyz, spin), qd = unspun(rd, spin);
    float free = besideConvex(clipSolid(id, q, qd, -rim, tMax, n),
                              clipSolid(id, q, qd, rim, tMax, n));
    return c.w < 0.0 ? 0.45 + 0.55 * free : free;   // biased: facets dim, they do not focus
}
// Share of a lamp's disc that a ball leaves free; rim: slope of the disc's radius seen from ro.
float besideOrb(int id, vec3 ro, vec3 rd, float rim, float tMax) {
    vec4 s = thing(id);
    vec3 f = s.xyz - ro;
    float t = dot(f, rd), r = abs(s.w);
    float away = length(f - t * rd), disc = max(rim * t, 1e-6);
    float reach = smoothstep(0.0, 1.0, (r + disc - away) / (2.0 * min(r, disc)));
    float cover = t > 0.0 && t < tMax ? reach * min(1.0, square(r / disc)) : 0.0;
    return 1.0 - cover * (s.w < 0.0 && !caustics ? 0.5 : 1.0);
}
// Share of one sub-disc of a lamp that a point sees past the things in the masks.
float lampSeen(vec3 ro, vec3 rd, float rim, float tMax, ivec3 masks) {
    float free = 1.0;
    for (int m = masks.x; m != 0; m &= m - 1)
        free *= besideOrb(lowestBit(m), ro, rd, rim, tMax);
    for (int m = masks.y; m != 0; m &= m - 1)
        free *= besideSolid(kCubes + lowestBit(m), ro, rd, rim, tMax);
    return free;
}

// Gain of the light that glass balls send to p over a lamp of power 1. The table is made for
// parallel light. A lamp at distance S comes to the same by z -> z / (1 + z/S), which keeps lines
// straight and sends the lamp to infinity: so r (1/z + 1/S) stands for r / z.
float throughBalls(vec3 p, vec3 nor, vec3 lampAt, int mask) {
    float sum = 0.0;
    for (int m = mask; m != 0; m &= m - 1) {
        vec4 s = thing(lowestBit(m));
        vec3 axis = s.xyz - lampAt, q = p - s.xyz;
        float far = length(axis), z = dot(q, axis) / far, r = abs(s.w);
        float side2 = max(dot(q, q) - z * z, 0.0), facing = -dot(q, nor);
        if (z < r || side2 > square(kGainTan * z) || facing <= 0.0) continue;
        vec2 at = vec2(sqrt(side2) / z / kGainTan, r * (1.0 / z + 1.0 / far));
        float most = texture(gain, (at * (kGainSize - 1.0) + 0.5) / vec2(textureSize(gain, 0))).x;
        if (most < 0.01) continue;
        float away = length(q);   // biased: of all things only bipyramids stand in its way
        for (int k = kBipyramids; k < kBipyramids + 3; ++k)
            most *= besideSolid(k, liftOff(p, nor), -q / away, 0.0, away);
        sum += most * facing / (z * square(far + z));   // as if it came from the ball's centre
    }
    return sum;
}

// Light that a matt surface sends on, for an albedo of 1, and the lamps' sheen on one that shines:
// GGX of width alpha, Kelemen and Szirmay-Kalos' form, before Fresnel.
vec3 lampsLight(vec3 p, vec3 nor, vec3 rd, float alpha, out vec3 sheen) {
    vec3 sum = vec3(0.0);
    sheen = vec3(0.0);
    int samples = shadows >= 2 ? shadowSamples : 1;
    float spread = shadows >= 2 ? lampRadius : 0.0;
    float size = shadows == 3 ? 0.0 : spread / sqrt(float(samples));   // sampled: rays, no cones
    for (int k = 0; k < 3; ++k) {
        vec3 at = thing(kLamps + k).xyz, axis = at - p, power = lampLight(k);
        float far2 = dot(axis, axis), inverse = inversesqrt(far2);
        float cosine = dot(axis, nor) * inverse, sees = 0.0;
        ivec3 masks = metTowards(k, -axis);
        if (caustics) sum += power * throughBalls(p, nor, at, masks.z);
        if (cosine <= 0.0) continue;
        if (shadows == 0) {
            sees = 1.0;
        } else {
            vec3 beside = abs(axis.y) * inverse > 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0);
            vec3 u = normalize(cross(axis, beside)), v = cross(u, axis) * inverse;
            for (int j = 0; j < samples; ++j) {   // sub-discs on a phyllotaxis; one is the lamp
                float a = 2.0 * kPi * kGolden * float(j);
                float r = (spread - size) * sqrt((float(j) + 0.5) / float(samples));
                vec3 to = axis + r * (u * cos(a) + v * sin(a));
                float far = length(to);
                sees += lampSeen(liftOff(p, nor), to / far, size / far, far, masks);
            }
            sees /= float(samples);
        }
        vec3 light = power * (sees * cosine / far2);
        sum += light;
        vec3 mid = axis * inverse - rd;
        float mid2 = max(dot(mid, mid), 1e-6), up = max(dot(mid, nor), 0.0);
        float wide = square(min(alpha + 0.5 * lampRadius * inverse, 1.0));
        float lobe = wide / square(1.0 + up * up / mid2 * (wide - 1.0));
        sheen += light * lobe / max(mid2, 0.1);   // (l.m)^2 is |l - rd|^2 / 4
    }
    return sum;
}

// What glows along a ray before tMax: haze round the lamps, and their faces. A lamp's light has the
// strength 1 / d^2 at a distance d, which grows without bound where the ray passes close to it. But
// with h the ray's least distance and t = h tan x along it, dt / d^2 = dx / h: even in x, the angle
// under which the lamp sees the ray. So points are spread evenly over that angle, and few do. The
// ray's footprint is width0 + width * t; nothing shines narrower than that. jitter: where between
// its points, 0 to 1.
vec3 lampGlow(vec3 ro, vec3 rd, float tMax, float width0, float width, float jitter) {
    vec3 sum = vec3(0.0);
    if (!shafts) jitter = 0.5;
    for (int k = 0; k < 3; ++k) {
        vec3 f = thing(kLamps + k).xyz - ro;
        float t = dot(f, rd), foot = width0 + width * max(t, 0.0);
        vec3 l = f - t * rd;
        float away2 = dot(l, l), blur = max(lampRadius, foot);
        float away = sqrt(away2 + blur * blur);   // from the lamp's face, not from its centre
        float first = -atan(t / away), all = atan((tMax - t) / away) - first;
        float through = 0.0;
        for (int j = 0; j < glowSamples && haze > 0.0; ++j) {
            float x = first + all * (float(j) + jitter) / float(glowSamples), far = away / cos(x);
            float seen = 1.0;
            if (shafts) {
                vec3 to = f - (t + away * tan(x)) * rd;
                float d = max(length(to), 1e-4);
                seen = lampSeen(thing(kLamps + k).xyz - to, to / d, lampRadius / d, d,
                                metTowards(k, -to / d));
            }
            through += seen * exp(-haze * (t + away * tan(x) + far));
        }
        float scattered = haze / (4.0 * kPi) * kPi * all / away * through / float(glowSamples);
        // The face: dimmed to what film can hold, round towards its rim, never a flat disc.
        float seen = max(lampRadius, 1.2 * foot), disc = max(1.0 - away2 / (seen * seen), 0.0);
        float face = t > 0.0 && t < tMax ? disc * square(lampRadius / seen) : 0.0;
        sum += lampLight(k) * (scattered * kHazeTint + 0.032 * face);
    }
    return sum;
}

// ---- Materials ----------------------------------------------------------------------------------
// Patterns are drawn as a pixel's mean, not at its middle: the mean over [a, b] of a line or a
// stripe is the difference of its integral at b and at a, divided by b - a. So nothing far off
// shimmers.

// Edges are rounded for light only: near one the normal leans over to the face beyond. A line is
// engraved along those of a bipyramid.
vec3 rounded(int id, vec3 p, vec3 nor, float w, out float engraved) {
    vec4 spin = attitude(id);
    vec3 q = unspun(p - thing(id).xyz, spin), n = unspun(nor, spin);
    float edge = clamp(w, 0.016, 0.1), wide = max(0.011, w);   // m
    engraved = 0.0;
    if (id < kBipyramids) {
        n = sign(q) * max(abs(q) - kCubeHalf + edge, 0.0);
    } else {
        vec3 inward = abs(q) * inversesqrt(max(1.0 - n * n, 1e-6));   // m, in the face
        float away = abs(min(inward.x, min(inward.y, inward.z)) - 0.085);
        engraved = (1.0 - smoothstep(0.5 * wide, wide, away)) * 0.011 / wide;
        n *= smoothstep(0.0, 1.0, abs(q) / edge);
    }
    return normalize(spun(n, spin));
}
vec3 metal(vec3 tint, float cosine) { return mix(tint, vec3(1.0), pow(1.0 - cosine, 5.0)); }

// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}
// Mean over a width w of a random tone for every unit of x, in [-1, 1]; wide ones see no tone.
float stripes(float x, float w, int seed) {
    w = clamp(w, 1e-4, 1.0);
    float a = x - 0.5 * w, b = x + 0.5 * w, edge = floor(b);
    float before = random3(ivec3(int(floor(a)), seed, 3)).x;
    float after = random3(ivec3(int(edge), seed, 3)).x;
    float share = clamp((b - edge) / w, 0.0, 1.0);
    return (2.0 * mix(before, after, share) - 1.0) * (1.0 - smoothstep(0.4, 1.0, w));
}

// Stone in triangles: three families of joints; a tile's tone is the sum of its three stripes'.
// Inlaid circles mark the shells. All is a mean over the footprint: w across, w * slope along.
vec3 floorStone(vec2 p, float w, vec2 slope, out float inlay) {
    float tone = 0.0, joints = 0.0;
    for (int k = 0; k < 3; ++k) {
        vec2 across = k == 0 ? vec2(1.0, 0.0) : vec2(-0.5, k == 1 ? 0.8660254 : -0.8660254);
        float x = dot(p, across) / kTile;
        float wide = w * sqrt(1.0 + square(dot(slope, across))) / kTile;
        tone += stripes(x, wide, k);
        joints = max(joints, lines(x, 0.005, wide));
    }
    float r = length(p), wide = w * sqrt(1.0 + square(dot(slope, p / max(r, 1e-3))));
    float rings = 0.0;
    for (int k = 0; k < 3; ++k) {
        float radius = k == 0 ? kInnerShell : k == 1 ? kOuterShell : kOuterShell + 0.14;
        rings += lines(clamp((r - radius) / 20.0, -0.5, 0.5), k == 0 ? 0.001 : 0.0006, wide / 20.0);
    }
    // A compass rose between the shells: rays of brass, each second one short.
    float turns = (atan(p.y, p.x + 1e-9) / (2.0 * kPi) + 0.5) * kRays;
    float across = w * (1.0 + length(slope)) * kRays / (2.0 * kPi * max(r, 0.5));   // in rays
    float reach = mod(floor(turns + 0.5), 2.0) < 0.5 ? 1.0 : 0.45;
    float from = (r - kInnerShell - 0.12) / (kOuterShell - kInnerShell - 0.24);
    float soft = 0.5 * wide / (kOuterShell - kInnerShell) + 0.01;
    float along = smoothstep(-soft, soft, from) * smoothstep(-soft, soft, reach - from);
    float half1 = 0.15 * clamp(1.0 - from / reach, 0.0, 1.0);
    rings += along * lines(turns, half1, across);
    inlay = pattern * min(rings, 1.0);
    return linearColour(floorColour) * (1.0 + pattern * (0.17 * tone - 0.65 * joints));
}

// The wall: niches with a round arch, lit from their feet, and what of that light leaves them.
vec3 hallWall(vec3 p, float w) {
    float pitch = 2.0 * kPi * kHallRadius / kNiches;
    float cell = (atan(p.z, p.x) / (2.0 * kPi) + 0.5) * kNiches;
    float x = (fract(cell) - 0.5) * pitch, y = max(p.y, 0.0), soft = max(0.6 * w, 0.04);
    float inside = 1.5 - (y < 4.6 ? abs(x) : length(vec2(x, y - 4.6)));
    float niche = smoothstep(-soft, soft, inside), rim = exp(-square(inside / max(0.06, w)));
    float which = 0.5 + 0.5 * cos(2.0 * kPi * floor(cell) / kNiches * 3.0);
    vec3 colour = mix(vec3(0.09, 0.13, 0.95), vec3(0.52, 0.10, 0.80), which);
    float lit = (1.6 * exp(-0.55 * y) + 0.10) * exp(-0.5 * x * x);
    float spill = exp(-0.30 * y) / (1.0 + 0.35 * x * x);
    float edge = rim * min(0.06 / w, 1.0) * (0.12 + 0.5 * exp(-0.4 * y));
    // A screen before the light: a lattice of crossing bars, and panels on the wall between.
    float lattice = max(lines((x + y) / 0.55, 0.07, w / 0.4), lines((x - y) / 0.55, 0.07, w / 0.4));
    lit *= 1.0 - 0.55 * lattice;
    float seams = max(lines(y / 2.3, 0.012, w / 2.3), lines(cell * 3.0, 0.018, 3.0 * w / pitch));
    spill *= 1.0 - 0.7 * seams * (1.0 - niche);
    return hallLight * colour * (niche * lit + edge + 0.10 * spill + 0.004);
}
// The ceiling: two rings of panes, seen above all in what shines.
vec3 hallCeiling(vec2 p, float w) {
    float r = length(p), soft = max(w, 0.05);
    vec2 ring = abs(vec2(r - 6.2, r - 11.5)) - vec2(0.9, 0.55);
    vec2 inside = 1.0 - smoothstep(vec2(-soft), vec2(soft), ring);
    float round = (atan(p.y, p.x + 1e-9) / (2.0 * kPi) + 0.5) * 24.0;
    float bars = 1.0 - lines(round, 0.06, 4.0 * w / max(r, 1.0));
    vec3 night = vec3(0.30, 0.42, 1.5) * inside.x + vec3(0.65, 0.22, 1.0) * inside.y;
    return hallLight * (bars * night + vec3(0.004, 0.004, 0.014));
}

// ---- Transport ----------------------------------------------------------------------------------
// At each surface light splits: a mirrored ray, and in glass a refracted one. The tree that follows
// would double with every bounce; here two rays are alive, the brightest and one that waits. A
// third is lost, which changes no pixel, not even where all is glass of an index of 2.4. A ray's
// weight is the share of its light that reaches the eye: the product of all shares on its way.
const float kLeastCosine = 0.04;   // a footprint grows with 1 / cosine; no further than this
const vec3  kFloorBounce = vec3(0.048, 0.054, 0.176), kHallBounce = vec3(0.008, 0.007, 0.020);
const vec3  kFillAt = vec3(-3.0, 8.0, 9.0), kFillPower = vec3(1.8, 1.6, 1.2);   // m; from afar

// What a ray meets, as light sees it.
struct Surface {
    vec3 p, nor;           // place, and outward normal
    vec3 bent;             // the normal for light: edges of solids are rounded
    vec3 mirror, albedo;   // share that goes on mirrored; colour of what scatters the rest
    vec3 shine;            // light of its own
    float alpha;           // width of the lamps' sheen
    float w, width;        // footprint here, and what it gains a metre once mirrored
    float cosine;          // between the ray and the normal
    bool clear;            // glass: what is not mirrored goes in
};

// From within glass: back inside, and out. Beer's law: a metre lets through glassTint, t metres
// glassTint^t. Snell's law in vectors: outside the ray runs along n rd - (n c - k) nor, where
// k^2 = 1 - n^2 (1 - c^2) is negative where all is reflected.
void leaveGlass(Ray ray, out Ray one, inout Ray other) {
    vec3 p = ray.ro, nor;
    float t = leaveSolid(ray.inside, p, ray.rd, nor);
    vec3 weight = ray.weight * exp(t * log(max(linearColour(glassTint), 1e-3)));
    float cosine = clamp(dot(nor, ray.rd), 0.0, 1.0);
    float back = fresnel(cosine, 1.0 / glassIndex);
    float k2 = (1.0 - glassIndex) * (1.0 + glassIndex) + square(glassIndex * cosine);
    one = ray;
    one.ro = liftOff(p, -nor);
    one.rd = normalize(reflect(ray.rd, nor));
    one.weight = weight * back;
    if (k2 > 0.0) {
        other.ro = liftOff(p, nor);
        other.rd = normalize(glassIndex * ray.rd - (glassIndex * cosine - sqrt(k2)) * nor);
        other.weight = weight * (1.0 - back);
        other.inside = -1;
    }
}

// Where a ray meets something, moved back onto it: along a long ray t is rounded, and a start a
// thousandth off would meet its own surface again.
Surface arrive(Ray ray, Hit h) {
    Surface s;
    vec4 c = thing(min(h.id, kFloor - 1));
    s.p = ray.ro + h.t * ray.rd;
    s.nor = h.face.xyz;
    s.w = ray.width0 + ray.width * h.t;
    if (h.id < kCubes) {
        s.nor = normalize(s.p - c.xyz);
        s.p = c.xyz + abs(c.w) * s.nor;
    } else if (h.id != kWall) {
        s.p -= (dot(s.nor, s.p) - h.face.w) * s.nor;
    }
    s.cosine = clamp(-dot(ray.rd, s.nor), 0.0, 1.0);
    s.clear = h.id < kFloor && c.w < 0.0;
    s.bent = s.nor;
    s.width = ray.width;
    s.mirror = s.albedo = s.shine = vec3(0.0);
    s.alpha = 0.25;
    return s;
}

// The hall: its wall and ceiling shine and send nothing on; the floor is stone under polish.
void clothe(int id, vec3 rd, inout Surface s) {
    vec3 golden = linearColour(gold);
    if (id == kWall) {
        s.shine = hallWall(s.p, s.w / max(s.cosine, 0.2));
    } else if (id == kCeiling) {
        s.shine = hallCeiling(s.p.xz, s.w / max(s.cosine, 0.2));
    } else {
        float inlay;
        vec2 slope = rd.xz / max(-rd.y, 1e-4);
        s.albedo = floorStone(s.p.xz, s.w, slope, inlay);
        s.albedo = mix(s.albedo, 0.5 * golden, inlay);
        s.mirror = vec3(fresnel(s.cosine, kIorStone));
        s.mirror = gloss * mix(s.mirror, metal(golden, s.cosine), 0.5 * inlay);
        s.alpha = mix(0.6, 0.28, gloss);
    }
}

// What floats in it. A footprint w on a ball of radius r spans the angle w / r, and twice that once
// mirrored: far things in a ball are drawn as blurred as its pixels are wide.
void clotheThing(int id, inout Surface s) {
    float engraved = 0.0, radius = thing(id).w;
    vec3 golden = linearColour(gold);
    if (id >= kCubes) s.bent = rounded(id, s.p, s.nor, s.w, engraved);
    if (s.clear) {
        s.mirror = vec3(fresnel(s.cosine, glassIndex));
        if (id < kBalls) s.width += s.w / abs(radius);
    } else if (id < kBalls) {
        s.mirror = metal(linearColour(mirrorTint), s.cosine);
        s.width += 2.0 * s.w / (abs(radius) * max(s.cosine, kLeastCosine));
    } else if (id < kCubes) {
        s.albedo = 0.75 * golden;
        s.mirror = 0.3 * metal(golden, s.cosine);
        s.alpha = 0.36;
        s.width += 2.0 * s.w / (radius * max(s.cosine, kLeastCosine));
    } else if (id < kBipyramids) {
        s.mirror = vec3(fresnel(s.cosine, kIorVarnish));
        s.albedo = vec3(0.42, 0.44, 0.52);
    } else {
        s.albedo = (0.26 - 0.16 * engraved) * golden;
        s.mirror = (0.8 - 0.5 * engraved) * metal(golden, s.cosine);
        s.alpha = 0.42;
    }
}

// What a surface scatters towards the eye. The fill light reaches what is golden and nothing else:
// it is no lamp of the hall, casts no shadow, and wraps round a body, as a cube of its half cosine.
vec3 scattered(int id, vec3 rd, Surface s) {
    vec3 sheen, lit = lampsLight(s.p, s.bent, rd, s.alpha, sheen);
    lit += lampPower * mix(kFloorBounce, kHallBounce, 0.5 + 0.5 * s.nor.y);   // without shadows
    if (id < kCubes || (id >= kBipyramids && id < kFloor)) {
        vec3 fill = kFillAt - s.p;
        float facing = 0.5 + 0.5 * dot(fill, s.bent) * inversesqrt(dot(fill, fill));
        lit += fillLight * kFillPower * facing * facing * facing;
    }
    float left = 1.0 - min(s.mirror.r, min(s.mirror.g, s.mirror.b));
    return left * s.albedo * lit + s.mirror * sheen;
}

// Through the hall to the first thing; gives the light that comes from there and from the haze
// before it. one: mirrored on; other: into glass.
vec3 crossHall(inout Ray ray, float jitter, out Ray one, inout Ray other) {
    Hit h = intersect(ray.ro, ray.rd, ray.map);
    vec3 sum = ray.weight * lampGlow(ray.ro, ray.rd, h.t, ray.width0, ray.width, jitter);
    ray.weight *= exp(-haze * h.t);
    Surface s = arrive(ray, h);
    if (h.id < kFloor) clotheThing(h.id, s);
    else clothe(h.id, ray.rd, s);
    sum += ray.weight * s.shine;
    if (maxComponent(s.albedo * ray.weight) > kLeastThroughput)
        sum += ray.weight * scattered(h.id, ray.rd, s);

    vec3 back = reflect(ray.rd, s.clear ? s.nor : s.bent);
    back += max(1e-4 - dot(back, s.nor), 0.0) * s.nor;   // above the face itself, bent or not
    int map = h.id == kFloor && ray.map == kEye ? kEyeMirrored : kNowhere;
    one = Ray(liftOff(s.p, s.nor), normalize(back), ray.weight * s.mirror, s.w, s.width, -1, map);
    if (s.clear) {
        float eta = 1.0 / glassIndex;
        float k2 = (1.0 - eta) * (1.0 + eta) + square(eta * s.cosine);
        vec3 into = normalize(eta * ray.rd + (eta * s.cosine - sqrt(k2)) * s.nor);
        other = Ray(liftOff(s.p, -s.nor), into, ray.weight * (1.0 - s.mirror), s.w, s.width, h.id,
                    kNowhere);
    }
    return sum;
}

// Light that arrives at ro against rd. pixel: angle of a pixel, rad.
vec3 render(vec3 ro, vec3 rd, float pixel, float jitter) {
    vec3 sum = vec3(0.0);
    Ray ray = Ray(ro, rd, vec3(1.0), 0.0, pixel, -1, kEye);
    Ray later = Ray(ro, rd, vec3(0.0), 0.0, pixel, -1, kNowhere);
    for (int n = 0; n < bounces; ++n) {
        Ray one = ray, other = ray;   // what leaves this surface: mirrored, and refracted
        other.weight = vec3(0.0);
        if (ray.inside >= 0) leaveGlass(ray, one, other);
        else sum += crossHall(ray, fract(jitter + kGolden * float(n)), one, other);
        // On with the brightest of these and the one that waits; the next bright one waits.
        bool swap = maxComponent(other.weight) > maxComponent(one.weight);
        ray = one;
        if (swap) {  // browsers choose no structs by ?:
            ray = other;
            other = one;
        }
        float best = maxComponent(ray.weight);
        if (maxComponent(other.weight) > maxComponent(later.weight)) later = other;
        if (best < maxComponent(later.weight)) {
            Ray moved = later;
            later = ray;
            ray = moved;
        }
        if (maxComponent(ray.weight) < kLeastThroughput) break;
    }
    return sum;
}

// ---- Camera -------------------------------------------------------------------------------------
// The eye goes round the hall's axis and looks at a point near it; `mainDirections` asks for its
// place, too. On 36 x 24 mm film a lens of focal length f sees 24 mm / f of a metre a metre away.

void camera(out vec3 ro, out vec3 right, out vec3 forward) {
    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    float height = clamp(cameraHeight - 8.0 * orbit.y, 0.1, 12.0);
    ro = vec3(cameraDistance * sin(angle), height, cameraDistance * cos(angle));
    right = vec3(cos(angle), 0.0, -sin(angle));
    forward = normalize(vec3(0.0, targetHeight, 0.0) + targetShift * right - ro);
    right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
}

// ---- Passes -------------------------------------------------------------------------------------
// What does not depend on the pixel is worked out once: the gain of light behind a ball, where all
// things are, and which of them can lie in each direction from a lamp or the eye. That last map is
// why shadow cones cost little: a cone asks for the bits of its cell, and tests only the few things
// that they name.

// Gain of parallel light behind a glass ball: tangent off the axis across, r / distance up.
void mainGain(out vec4 colour, in vec2 pixel) {
    vec2 uv = (pixel - 0.5) / (kGainSize - 1.0);
    float tangent = uv.x * kGainTan, z = 1.0 / max(uv.y, 0.01);
    float blur = max(lampRadius / 6.0, 0.03), sum = 0.0;   // the lamp's disc, 6 m away
    for (int k = 0; k < kRings; ++k) {
        float b = (float(k) + 0.5) / float(kRings);
        float bent = 2.0 * (asin(b) - asin(b / glassIndex)), c = cos(bent);   // b <= 1: inside
        if (c < 0.05) continue;
        float ring = abs(b - z * sin(bent)) / (c * z);
        float away = abs(tangent - ring);
        if (away > blur) continue;
        float angle = tangent * tangent + ring * ring - blur * blur;
        float share = acos(clamp(angle / max(2.0 * tangent * ring, 1e-9), -1.0, 1.0)) / kPi;
        float passes = square(1.0 - fresnel(sqrt(1.0 - b * b), glassIndex));
        sum += 2.0 * b / float(kRings) * passes * share;
    }
    float rim = 1.0 - smoothstep(0.85, 1.0, uv.x);
    colour = vec4(rim * sum / square(blur * z));
}

// A wave round a shell, the same for every body on it.
vec3 onShell(int shell, int level, float phase) {
    float a = 2.0 * kPi * phase, radius = shell == 0 ? kInnerShell : kOuterShell;
    float wave = shell == 0 ? 0.45 * sin(a) : 0.6 * sin(2.0 * a + 1.0);
    return vec3(radius * sin(a), 0.95 + kStep * float(level) + wave, radius * cos(a));
}
vec3 fromOctahedron(vec2 p) {
    vec3 d = vec3(p.x, 1.0 - abs(p.x) - abs(p.y), p.y);
    vec2 folded = (1.0 - abs(d.zx)) * mix(vec2(-1.0), vec2(1.0), greaterThan(d.xz, vec2(0.0)));
    if (d.y < 0.0) d.xz = folded;
    return normalize(d);
}

// Octahedral maps, one above the other, of what may lie in each direction from the lamps (or from
// any point of a lamp), from the eye, and from its mirror image in the floor.
void mainDirections(out vec4 colour, in vec2 pixel) {
    ivec2 cell = ivec2(pixel);
    int map = cell.y / kCells;
    vec2 low = 2.0 * vec2(cell.x, cell.y - map * kCells) / float(kCells) - 1.0;
    float side = 2.0 / float(kCells), narrow = 1.0;
    vec3 middle = fromOctahedron(low + 0.5 * side), at = thing(kLamps + map).xyz, right, forward;
    if (map >= kEye) camera(at, right, forward);
    if (map == kEyeMirrored) at.y = -at.y;
    for (int j = 0; j < 4; ++j)   // a cell's farthest points are corners, also where it is folded
        narrow = min(narrow, dot(middle, fromOctahedron(low + side * vec2(j & 1, j >> 1))));
    float own = acos(clamp(narrow, -1.0, 1.0)) + 0.002, wide = 0.01;
    if (map < kEye) wide += lampRadius;
    float cosine = cos(own), sine = sin(own), gainCosine = cos(atan(kGainTan) + own);
    ivec3 masks = ivec3(0);
    for (int id = 0; id < kLamps; ++id) {
        vec4 c = thing(id);
        vec3 f = c.xyz - at;
        float far = max(length(f), 1e-6), size = (id < kCubes ? abs(c.w) : boundOf(id)) + wide;
        float its = min(size / far, 1.0), along = dot(f, middle) / far;   // sine of its half angle
        // Nearer to the cell's middle than both half angles together: cos a cos b - sin a sin b.
        if (along > cosine * sqrt(1.0 - its * its) - sine * its) {
            if (id < kCubes) masks.x |= 1 << id;
            else masks.y |= 1 << (id - kCubes);
        }
        if (id < kBalls && c.w < 0.0 && along > gainCosine) masks.z |= 1 << id;
    }
    colour = vec4(masks, 0.0);
}
vec4 spinOf(vec3 axis, float turns) { return vec4(axis * sin(kPi * turns), cos(kPi * turns)); }

// Row 0: place and size (glass: negative). Row 1: attitude, a unit quaternion.
void mainThings(out vec4 colour, in vec2 pixel) {
    int id = int(pixel.x);
    bool second = pixel.y > 1.0;
    colour = vec4(0.0, -100.0, 0.0, 0.01);
    bool there = id < kBalls ? id < spheres : id < kCubes ? id < kBalls + balls
        : id < kBipyramids ? id < kCubes + cubes : id < kLamps + 3;
    if (!there) return;
    float i = float(id < kBalls ? id : id < kCubes ? id - kBalls : id - kCubes);
    float any = fract((i + 0.5) * kGolden + 0.17), a = 2.0 * kPi * i / float(max(spheres, 1));
    if (id < kBalls) {
        float hz = 0.03125 + 0.00390625 * float(id % 3);
        float rise = (id < 6 ? kRise[min(id, 5)] : any) + cycles(hz);
        colour = vec4(kSphereRing * sin(a), 3.5 + 2.5 * sin(2.0 * kPi * rise),
                      kSphereRing * cos(a), any < glass ? -kSphereRadius : kSphereRadius);
    } else if (id < kBipyramids) {
        bool cube = id >= kCubes;
        int n = int(i), j = n >> 1, level = cube ? j + (j + 1) / 2 : 3 * j + 1;   // no two the same
        float sense = (n & 1) == 0 ? 1.0 : -1.0;
        float place = any + sense * cycles(0.015625 + 0.00390625 * float(n % 4));
        float size = cube ? (any < glassCubes ? -kCubeHalf : kCubeHalf) : kBallRadius;
        colour = vec4(onShell(n & 1, level, place + (cube ? 0.38 : 0.0)), size);
        vec3 axis = normalize(random3(ivec3(n, 4, 2)) - vec3(0.5, 0.499, 0.5));
        if (second) colour = spinOf(axis, cycles(0.0625 + 0.015625 * float(n % 3)));
    } else if (id < kLamps) {
        float n = float(id - kBipyramids);
        vec3 at = n < 0.5 ? vec3(-1.95, 2.3, -0.3) : n < 1.5 ? vec3(0.44, 1.8, 1.3)
            : vec3(1.05, 4.0, -0.2);
        at.y += 0.2 * sin(2.0 * kPi * (0.37 * n + cycles(0.0625 + 0.015625 * n)));
        colour = vec4(at, bipyramids == 1 ? -kBipyramidHalf.y : kBipyramidHalf.y);
        vec4 spin = spinOf(vec3(0, 1, 0), 0.13 * n + cycles(0.03125 + 0.0078125 * n));
        if (second) colour = spin;
    } else {
        float n = float(id - kLamps), sense = n == 1.0 ? -1.0 : 1.0;
        vec3 beat = sin(2.0 * kPi * vec3(cycles(lampSpeed * 0.046875),
                                         cycles(lampSpeed * 0.0625) + 0.3,
                                         cycles(lampSpeed * 0.03125) + 0.6));
        vec3 path = n < 0.5 ? vec3(6.3 + 0.5 * beat.x, 2.3 + 0.6 * beat.y, 0.16)   // away, up, turn
            : n < 1.5 ? vec3(6.6 + 0.4 * beat.y, 5.4 + 0.7 * beat.z, 0.62)
            : vec3(3.4 + beat.z, 8.6 + 0.6 * beat.x, 0.42);
        float turns = path.z + sense * cycles(lampSpeed * 0.0078125 * (n + 1.0));
        colour = vec4(path.x * sin(2.0 * kPi * turns), path.y, path.x * cos(2.0 * kPi * turns),
                      lampRadius);
    }
}

// ---- Image --------------------------------------------------------------------------------------
// From a pixel to a ray, by a pinhole, and from light to what a display shows, by one curve, which
// is the same in all scenes.

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
    vec3 ro, right, forward;
    camera(ro, right, forward);
    vec3 up = cross(right, forward);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float lens = focalLength / 24.0;
    vec3 rd = normalize(uv.x * right + uv.y * up + lens * forward);
    float falloff = square(dot(rd, forward));   // half of a simple lens's cos^4
    float jitter = fract(shuffledQuarters(ivec2(fragCoord)) + fragCoord.x);
    vec3 light = render(ro, rd, 1.0 / (lens * iResolution.y), jitter);
    fragColor = vec4(display(exp2(exposure) * falloff * light) + dither(fragCoord), 1.0);
}
