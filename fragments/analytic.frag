// Analytic: the intersection laboratory.
//
// A still life of everything that a ray meets in closed form: spheres, boxes, a mesh of triangles,
// discs, a cylinder, a cone, an ellipsoid and a torus, in glass, mirror and glaze on an engraved
// dial. Each shape is met twice over, by the formula of the textbooks and by one that keeps its
// digits. `magnitude` takes the world to where the first breaks, `wipe` shows both in one picture,
// and `view` the error of the hit distance.
//
// What it shows (tests/fragments, 98,304 rays a row): the share in % of rays that flip between hit
// and miss, from 1e2 and from 1e4 radii away, and the relative error of the distance that 99 % stay
// below.
//                                     textbook            robust
//   sphere                            0.04, 46 %  4e-4    0, 0.008 %      2e-7
//   ellipsoid                         0.06, 52 %  4e-4    0, 0.010 %      2e-7
//   cylinder                          0.04, 43 %  5e-4    0, 0.011 %      2e-7
//   cone                              0.08, 26 %  5e-4    0, 0.004 %      1e-7
//   disc                              0.00, 0.01 %  2e-7  0.002, 0.012 %  2e-7
//   torus                             52, 50 %    3e-2    0, 0.013 %      1e-7
//   sliver 1e-4 as high as long                   5e-3                    6e-7
//   edges, corners of the crystal     35, 59 % leak       0 of 1e5, 0 of 1e5
//   box: edge, ray in a face          12, 14 % missed     0, 0
//   own surface again, eye at 1e6 m   13 %                0
//
// Method   Robust forms slide the ray's start to its point nearest the shape, so that what cancels
//          does so once, in a subtraction that is nearly exact. Hits are moved back onto their
//          surface, along the ray in twice the digits (normals to 3e-5 degrees with the eye at
//          1 km), and leave it by 8 ulp. Where the eye steps back a robust ray starts nearby. One
//          path a pixel: at glass the stronger way is followed, up to kPending weaker ones wait.
//          Lights are discs; shadows are cones to `shadowSamples` sub-discs, each shape's share in
//          closed form: smooth with one cone, exact in the limit of many. Biased: glass dims light,
//          it does not focus it. The error view puts the hit in twice the digits and reads off how
//          far from the surface it lies. Picked by specialisation, the other formulas cost nothing.
// Sources  Haines, Guenther, Akenine-Moeller, Ray Tracing Gems ch. 7 (2019), eq. 5: sphere. Woop,
//          Benthin, Wald, JCGT 2(1) (2013): triangles. Ize, JCGT 2(2) (2013): slabs. Dekker, Numer.
//          Math. 18 (1971): exact product. Born and Wolf, Principles of Optics, 1.5: Fresnel.
//          Vogel, Math. Biosci. 44 (1979). Textbook: Shirley, Fundamentals of Computer Graphics
//          (2002): Cramer. Ferrari's quartic.
// Units    1 unit = 1 m, y up, linear sRGB colour until the display curve; lamps: radiance x m^2.
// Passes   none but the image.
// Bounds   llvmpipe ends the loops of a pixel after 65,535 turns together. Each quality knob alone
//          stays below at its reference; all at once (64 x 48 x 2 x 64) need a GPU.
// Defaults From `glint study presets/analytic.toml`, all on its frontier: 10 bounces are 0.011
//          (RMSE) from 48, one cone of shadow 0.005 from 64 samples in an eighth of their time.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Laboratory
uniform int   intersector;     //@ 1 {textbook, robust, wipe} "formulas that meet the shapes"
uniform float magnitude;       //@ 1 [1, 1000000] log "how far from ordinary numbers"
uniform int   magnify;         //@ 0 {distance, scale, place} "what it multiplies"
uniform float wipe;            //@ 0.5 [0, 1] "textbook left of it, robust right of it"
uniform int   view;            //@ 0 {picture, error} "error: of the distance to the first hit"
//@ group Studio
uniform vec3  studioColour;    //@ #2f2c50 "floor and backdrop"
uniform vec3  glowColour;      //@ #ff7a3a "light on the backdrop"
uniform float glow;            //@ 2.0 [0, 8] "brightness of the backdrop's light"
uniform float floorGloss;      //@ 1.0 [0, 1] "polish of the dial"
uniform float inlay;           //@ 1.0 [0, 1] "brass of the dial"
uniform float animation;       //@ 1.0 [0, 8] "speed of everything that moves"
//@ group Materials
uniform vec3  gemColour;       //@ #d0f0ff "of the crystal"
uniform vec3  glassColour;     //@ #d8fff4 "of ball and cube"
uniform float glassIndex;      //@ 1.52 [1, 2.5] "refractive index"
uniform vec3  goldColour;      //@ #ffcf7a "of the ring"
//@ group Light
uniform vec3  keyColour;       //@ #ffd9b0 "large lamp, front left"
uniform float keyPower;        //@ 1.0 [0, 4] "brightness of the large lamp"
uniform float keyRadius;       //@ 0.7 [0, 2] unit=m "its size; larger is softer"
uniform vec3  fillColour;      //@ #8fb8ff "soft light from above"
uniform float fillPower;       //@ 1.0 [0, 4] "brightness of the soft light"
uniform bool  shadows;         //@ on "shadows of both lights"
//@ group Camera
uniform float cameraDistance;  //@ 7.6 [4, 8.8] unit=m "from the middle"
uniform float cameraAngle;     //@ 0 [-180, 180] unit=deg "round the middle"
uniform float cameraHeight;    //@ 1.7 [0.1, 8] unit=m "of the eye"
uniform float targetHeight;    //@ 1.15 [0, 4] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-3, 3] unit=m "of the point looked at, to the right"
uniform float focalLength;     //@ 40 [12, 200] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.4 [-4, 4] unit=stop "before the display curve"
//@ group Quality
uniform int   bounces;         //@ 10 [1, 48] log quality reference=48 second=intersector=textbook "rays along one path"
uniform int   shadowSamples;   //@ 1 [1, 64] log quality reference=64 "cones to each light"
uniform int   antialiasing;    //@ 1 [1, 64] log quality reference=64 "rays through one pixel"

// ---- Constants and numbers ----------------------------------------------------------------------
// The set is laid out in metres round the studio's origin. `magnitude` then scales it, moves it or
// steps the eye back; the formulas below see world units alone, so they meet the numbers that hurt.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e30;                   // a miss
const float kTiny = 1e-20;                 // below: a direction's component counts as zero
const float kIorVarnish = 1.62;            // hard lacquer
const float kWiden = 1.001;                // of bounds, so that no touch is lost to rounding
const float kLeastThroughput = 0.012;      // a path that carries less is over
const float kTextbookLift = 1e-3;          // the textbooks' start of a secondary ray, any unit
const int   kPending = 4;                  // rays of a path that wait; one more is lost
// Places and sizes, m.
const vec4  kBall = vec4(-1.02, 0.56, 0.95, 0.56), kChrome = vec4(1.28, 0.44, 0.75, 0.44);
const vec4  kPearl = vec4(-0.22, 0.15, 1.85, 0.15), kBerry = vec4(-2.1, 0.2, 0.75, 0.2);
const vec3  kRingCentre = vec3(0.0, 1.36, -0.75);
const vec2  kRing = vec2(1.20, 0.16);      // radii, large and small
const float kGemSize = 0.52;               // from its centre to a corner
const vec3  kEggCentre = vec3(-1.95, 1.36, -0.7), kEggAxes = vec3(0.30, 0.41, 0.30);
const vec3  kDrumCentre = vec3(-1.95, 0.475, -0.7);
const vec2  kDrum = vec2(0.50, 0.475);     // radius, half height
const vec3  kConeApex = vec3(1.95, 1.80, -0.75);
const vec2  kCone = vec2(0.37, 1.0);       // slope of the radius, height
const vec3  kPlinthCentre = vec3(1.95, 0.40, -0.75), kPlinthHalf = vec3(0.52, 0.40, 0.52);
const vec3  kCubeCentre = vec3(0.50, 0.302, 1.50), kCubeHalf = vec3(0.30, 0.30, 0.30);
const float kPlinthTurn = 0.45, kCubeTurn = 0.62;   // rad
const vec3  kMirrorCentre = vec3(3.0, 1.30, -2.3), kMirrorNormal = vec3(-0.56, -0.05, 0.827);
const float kMirrorRadius = 1.25;
const float kDial = 3.6, kWall = 9.0, kCove = 3.5;       // radii of the dial, room and its curve
const vec3  kKey = vec3(-4.2, 5.6, 3.6), kFill = vec3(0.8, 7.0, -0.6);
const float kFillRadius = 2.4, kCeiling = 9.0;
const vec3  kStageLow = vec3(-2.6, -0.01, -3.2), kStageHigh = vec3(4.2, 2.9, 2.1);
const int   kFloorId = 0, kWallId = 1, kLampId = 2, kBallId = 3, kChromeId = 4, kPearlId = 5;
const int   kBerryId = 6, kRingId = 7, kGemId = 8, kEggId = 9, kDrumId = 10, kDrumTopId = 11;
const int   kConeId = 12, kPlinthId = 13, kCubeId = 14, kMirrorId = 15;

const vec2  kFive[5] = vec2[5](vec2(0.0, 1.0), vec2(0.951056516, 0.309016994),
    vec2(0.587785252, -0.809016994), vec2(-0.587785252, -0.809016994),
    vec2(-0.951056516, 0.309016994));      // corners of a pentagon

struct Hit { float t; int id; vec3 face; };   // face: outward, of triangles and boxes
bool robust = true;            // which formulas this pixel uses
float worldScale = 1.0;        // world units in one metre of the studio
vec3 worldPlace = vec3(0.0);   // where the studio's origin lies

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

// Cycles since the start, modulo 1, of a motion; its frequency is cut to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }
// 0, which compilers cannot know: a loop that starts there is not unrolled, and compiled sooner.
int loopStart() { return min(0, int(iSampleRate)); }

vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 unit(vec3 v) { return v * inversesqrt(max(dot(v, v), 1e-30)); }
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

// The direction behind a surface; eta: index before over index beyond. Where nothing gets through,
// along the surface: fresnel() is 1 there.
vec3 refractExactly(vec3 rd, vec3 nor, float eta) {
    float cosine = clamp(-dot(rd, nor), 0.0, 1.0), sine = eta * length(cross(rd, nor));
    // 1 - sine^2, of what is small: near the critical angle of a dense glass the cosine, near 1, has
    // lost the digits that decide.
    float k = cosine < 0.7 ? (1.0 - eta) * (1.0 + eta) + square(eta * cosine)
        : (1.0 - sine) * (1.0 + sine);
    return unit(eta * rd + (eta * cosine - sqrt(max(k, 0.0))) * nor);
}

// ---- Textbook forms: shapes at the origin, the ray as it comes ----------------------------------
// Put p = ro + t rd into a shape's equation and a polynomial in t is left. A quadric gives a t^2 +
// 2 b t + c = 0, so t = (-b +- sqrt(b^2 - a c)) / a. Right on paper: but from a distance D a sphere
// of radius r has b^2 and a c near D^2, and their difference, which decides over hit or miss, near
// r^2. A float has 24 bits; where (D / r)^2 nears 2^24, at 4,000 radii, none is left.

float firstAhead(float near, float far) { return near > 0.0 ? near : far > 0.0 ? far : -1.0; }

vec2 textbookRoots(float a, float b, float c) {   // of a t^2 + 2 b t + c
    float d = b * b - a * c;
    if (d < 0.0) return vec2(-1.0);
    float s = sqrt(d);
    return vec2(-b - s, -b + s) / a;
}
float textbookSphere(vec3 ro, vec3 rd, float r) {
    vec2 t = textbookRoots(1.0, dot(ro, rd), dot(ro, ro) - r * r);
    return firstAhead(t.x, t.y);
}
float textbookEllipsoid(vec3 ro, vec3 rd, vec3 axes) {
    vec3 u = ro / axes, v = rd / axes;
    vec2 t = textbookRoots(dot(v, v), dot(u, v), dot(u, u) - 1.0);
    return firstAhead(t.x, t.y);
}
float textbookCylinder(vec3 ro, vec3 rd, float r, float h) {   // |y| < h, open ends
    vec2 u = ro.xz, v = rd.xz, t = textbookRoots(dot(v, v), dot(u, v), dot(u, u) - r * r);
    vec2 y = abs(ro.y + t * rd.y);
    return firstAhead(y.x < h ? t.x : -1.0, y.y < h ? t.y : -1.0);
}
float textbookCone(vec3 ro, vec3 rd, float slope, float h) {   // apex up, -h < y < 0, open end
    vec3 u = vec3(ro.xz, slope * ro.y), v = vec3(rd.xz, slope * rd.y), w = vec3(1.0, 1.0, -1.0);
    vec2 t = textbookRoots(dot(w * v, v), dot(w * u, v), dot(w * u, u));
    vec2 y = ro.y + t * rd.y;
    t = vec2(y.x > -h && y.x < 0.0 ? t.x : -1.0, y.y > -h && y.y < 0.0 ? t.y : -1.0);
    return t.x > 0.0 && t.y > 0.0 ? min(t.x, t.y) : max(t.x, t.y);
}
float textbookDisc(vec3 ro, vec3 rd, vec3 nor, float r) {
    float t = -dot(ro, nor) / dot(rd, nor);
    vec3 p = ro + t * rd;
    return dot(p, p) < r * r ? t : -1.0;
}
float textbookBox(vec3 ro, vec3 rd, vec3 halfSize, out vec3 face) {   // as six rectangles
    float nearest = kFar;
    vec3 axis = vec3(1.0, 0.0, 0.0);
    face = axis;
    for (int k = 0; k < 6; ++k) {
        float side = k < 3 ? 1.0 : -1.0, t = (side * halfSize.x - ro.x) / rd.x;
        vec2 p = abs(ro.yz + t * rd.yz);
        if (p.x < halfSize.y && p.y < halfSize.z && t > 0.0 && t < nearest) {
            nearest = t;
            face = side * axis;
        }
        ro = ro.yzx;
        rd = rd.yzx;
        halfSize = halfSize.yzx;
        axis = axis.zxy;
    }
    return nearest < kFar ? nearest : -1.0;
}
float textbookTriangle(vec3 ro, vec3 rd, vec3 a, vec3 b, vec3 c) {   // Cramer's rule
    vec3 ab = a - b, ac = a - c, ao = a - ro, across = cross(ac, rd);
    float det = dot(ab, across);
    float beta = dot(ao, across) / det, gamma = dot(rd, cross(ab, ao)) / det;
    float t = -dot(ac, cross(ab, ao)) / det;
    return beta > 0.0 && gamma > 0.0 && beta + gamma < 1.0 ? t : -1.0;
}
float cubeRoot(float x) { return sign(x) * pow(abs(x), 1.0 / 3.0); }

float textbookTorus(vec3 ro, vec3 rd, float large, float small) {   // axis y; Ferrari's quartic
    float n = dot(ro, rd), g = 4.0 * large * large, k = dot(ro, ro) + 0.25 * g - small * small;
    float a = 4.0 * n, b = 4.0 * n * n + 2.0 * k - g * dot(rd.xz, rd.xz);
    float c = 4.0 * n * k - 2.0 * g * dot(ro.xz, rd.xz), d = k * k - g * dot(ro.xz, ro.xz);
    float p = b - 0.375 * a * a, q = c - 0.5 * a * b + 0.125 * a * a * a;
    float w = d - 0.25 * a * c + 0.0625 * a * a * b - 0.01171875 * a * a * a * a;
    float l = -p * p / 3.0 - 4.0 * w, m = -2.0 * p * p * p / 27.0 + 8.0 * p * w / 3.0 - q * q;
    float disc = 0.25 * m * m + l * l * l / 27.0, s = sqrt(max(disc, 0.0)), z;
    if (disc >= 0.0) z = cubeRoot(-0.5 * m + s) + cubeRoot(-0.5 * m - s);
    else z = 2.0 * sqrt(-l / 3.0) * cos(acos(clamp(1.5 * m / l * sqrt(-3.0 / l), -1.0, 1.0)) / 3.0);
    z = sqrt(max(z - 2.0 * p / 3.0, 1e-12));
    float best = kFar;
    for (int branch = 0; branch < 2; ++branch) {   // x^2 + z x + u, and with -z
        float u = 0.5 * (p + z * z - q / z), e = 0.25 * z * z - u;
        if (e > 0.0) {
            float h = sqrt(e), far = -0.5 * z + h - 0.25 * a, near = far - 2.0 * h;
            if (near > 0.0) best = min(best, near);
            else if (far > 0.0) best = min(best, far);
        }
        z = -z;
    }
    return best < kFar ? best : -1.0;
}

// ---- Robust forms -------------------------------------------------------------------------------
// The same equations, met from close by. Slide the ray's start to its point nearest the shape: then
// b = 0, and r^2 - |ro|^2 has numbers of the shape's own size. The distance slid is added last. A
// triangle is met by the signs of three edge functions, each a difference of two products; two
// triangles that share an edge work out the same two products, so that one has e and the other
// exactly -e: the ray is on one side of the edge or the other, and never in between (no edge
// leaks).
//
// Drivers may fuse a product with a sum into one rounding, and take (a + b) - a for b; GLSL ES
// cannot forbid it. Both spoil what is built on roundings: splits by subtractions, the lost part of
// a sum, and that a b - c d is the negative of c d - a b. Masks of bits they leave alone.
vec3 upperHalf(vec3 v) { return uintBitsToFloat(floatBitsToUint(v) & 0xfffff000u); }
// What was rounded to a float, and is one for sure: a mask of its last bit stands between it and
// what comes next, so that no driver can fuse the two. That bit is the price, 1 ulp.
vec3 settled(vec3 v) { return uintBitsToFloat(floatBitsToUint(v) & 0xfffffffeu); }
// a * b as a float, and what that lost, itself a float (Dekker's product): products of halves are
// exact, fused or not.
vec3 exactProduct(vec3 a, vec3 b, out vec3 lost) {
    vec3 highA = upperHalf(a), lowA = a - highA, highB = upperHalf(b), lowB = b - highB;
    vec3 most = highA * highB, rest = (highA * lowB + lowA * highB) + lowA * lowB;
    vec3 product = settled(most + rest);
    lost = rest - (product - most);
    return product;
}
// ro + t rd as if in twice the digits (Knuth's sum), rounded once.
vec3 alongExactly(vec3 ro, vec3 rd, float t) {
    vec3 lost, product = exactProduct(vec3(t), rd, lost);
    vec3 sum = settled(ro + product), part = settled(sum - ro);
    return sum + ((ro - (sum - part)) + (product - part) + lost);
}
float intersectSphere(vec3 ro, vec3 rd, vec3 c, float r) {          // |rd| = 1
    vec3 f = ro - c;
    float b = dot(f, rd);
    vec3 l = f - b * rd;
    float d = r * r - dot(l, l);
    if (d < 0.0) return -1.0;
    float s = sqrt(d);
    return -b - s > 0.0 ? -b - s : -b + s;
}

// Slides a ray's start to the point nearest the origin, and says how far: then all numbers are of
// the shape's own size, and what cancels has cancelled once, in a subtraction that is nearly exact.
float slideNear(inout vec3 ro, vec3 rd) {
    float s = -dot(ro, rd);
    ro += s * rd;
    return s;
}
float robustEllipsoid(vec3 ro, vec3 rd, vec3 axes) {   // slid where it is a unit sphere
    vec3 u = ro / axes, v = rd / axes;
    float inverse = 1.0 / dot(v, v), s = -dot(u, v) * inverse;
    u += s * v;
    float d = 1.0 - dot(u, u);
    if (d < 0.0) return -1.0;
    float h = sqrt(d * inverse);
    return firstAhead(s - h, s + h);
}
float robustCylinder(vec3 ro, vec3 rd, float r, float h) {   // |y| <= h, open ends
    float inverse = 1.0 / max(dot(rd.xz, rd.xz), kTiny), s = -dot(ro.xz, rd.xz) * inverse;
    ro += s * rd;
    float d = r * r - dot(ro.xz, ro.xz), away = sqrt(max(d, 0.0) * inverse), rise = away * rd.y;
    float near = abs(ro.y - rise) <= h ? s - away : -1.0;
    float far = abs(ro.y + rise) <= h ? s + away : -1.0;
    return d < 0.0 ? -1.0 : firstAhead(near, far);
}
// Apex up, -h < y < 0, open end. Of the roots of a t^2 + 2 b t + c, q / a and c / q, neither
// cancels, also along the side; where a or q is 0, that root is nowhere within the height.
float robustCone(vec3 ro, vec3 rd, float slope, float h) {
    float s = slideNear(ro, rd), m = slope * slope * ro.y, n = slope * slope * rd.y;
    float a = dot(rd.xz, rd.xz) - n * rd.y, b = dot(ro.xz, rd.xz) - n * ro.y;
    float c = dot(ro.xz, ro.xz) - m * ro.y, d = b * b - a * c;
    float root = sqrt(max(d, 0.0)), q = (b < 0.0 ? root : -root) - b;
    vec2 t = vec2(q / a, c / q), y = abs(ro.y + 0.5 * h + t * rd.y);
    t = mix(vec2(-1.0), s + t, lessThan(y, vec2(d < 0.0 ? 0.0 : 0.5 * h)));
    float near = min(t.x, t.y);
    return near > 0.0 ? near : max(t.x, t.y);
}
float robustDisc(vec3 ro, vec3 rd, vec3 nor, float r) {   // has little to cancel
    float speed = dot(rd, nor), t = -dot(ro, nor) / (abs(speed) < kTiny ? kTiny : speed);
    vec3 p = ro + t * rd;
    return dot(p, p) <= r * r ? t : -1.0;
}
float robustBox(vec3 ro, vec3 rd, vec3 halfSize, out vec3 face) {   // as three slabs
    bvec3 level = lessThan(abs(rd), vec3(kTiny)), within = lessThanEqual(abs(ro), halfSize);
    vec3 inv = 1.0 / mix(rd, vec3(1.0), level);
    vec3 a = (-halfSize - ro) * inv, b = (halfSize - ro) * inv;
    vec3 enter = mix(min(a, b), mix(vec3(kFar), vec3(-kFar), within), level);
    vec3 leave = mix(max(a, b), vec3(kFar), level);
    float near = maxComponent(enter), far = min(leave.x, min(leave.y, leave.z));
    vec3 at = near > 0.0 ? -vec3(equal(enter, vec3(near))) : vec3(equal(leave, vec3(far)));
    face = at.x != 0.0 ? vec3(at.x, 0, 0) : at.y != 0.0 ? vec3(0, at.y, 0) : vec3(0, 0, at.z);
    face *= mix(vec3(-1.0), vec3(1.0), greaterThan(rd, vec3(0.0)));
    // The far side is moved by 3 ulp, what the roundings come to at most: no edge is lost.
    return near <= far * 1.00000036 ? firstAhead(near, far) : -1.0;
}
// Watertight triangles: what depends on the ray alone is worked out once for a mesh.
struct Shear { vec3 s; int axis; };
vec3 axisLast(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }
Shear shearAlong(vec3 rd) {
    vec3 a = abs(rd);
    int axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
    vec3 d = axisLast(rd, axis);
    return Shear(vec3(d.xy, 1.0) / d.z, axis);
}
vec3 sheared(vec3 v, Shear q) {
    v = axisLast(v, q.axis);
    return vec3(v.xy - q.s.xy * v.z, q.s.z * v.z);
}
// Corners sheared, relative to the ray's start; kFar for a miss, negative behind the start.
float robustTriangle(vec3 a, vec3 b, vec3 c) {
    vec3 e = settled(vec3(c.x, a.x, b.x) * vec3(b.y, c.y, a.y))
        - settled(vec3(b.x, c.x, a.x) * vec3(c.y, a.y, b.y));
    if (any(lessThan(e, vec3(0.0))) && any(greaterThan(e, vec3(0.0)))) return kFar;
    float det = e.x + e.y + e.z;
    return det == 0.0 ? kFar : dot(e, vec3(a.z, b.z, c.z)) / det;
}
// The distance again, of the one triangle that is met, with what the edge functions' products lost:
// in a sliver that is all there is.
float exactDistance(vec3 a, vec3 b, vec3 c) {
    vec3 x = vec3(c.x, a.x, b.x), y = vec3(b.y, c.y, a.y), u = vec3(b.x, c.x, a.x);
    vec3 v = vec3(c.y, a.y, b.y), lostXy, lostUv;
    vec3 e = (exactProduct(x, y, lostXy) - exactProduct(u, v, lostUv)) + (lostXy - lostUv);
    float sense = sign(e.x + e.y + e.z);
    e = max(e * sense, 0.0);   // within the triangle, whatever was rounded
    return dot(e, vec3(a.z, b.z, c.z)) / max(e.x + e.y + e.z, 1e-37);
}
// Implicit form of the torus of large radius 1 along a ray, and its slope.
vec2 torusAlong(vec3 ro, vec3 rd, float small, float t) {
    vec3 p = ro + t * rd;
    float rho = max(length(p.xz), 1e-6), out1 = rho - 1.0;
    return vec2(out1 * out1 + p.y * p.y - small * small,
                2.0 * (out1 * dot(p.xz, rd.xz) / rho + p.y * rd.y));
}
// Axis y. Scaled to large radius 1 and slid to the middle the quartic is t^4 + p t^2 + q t + w,
// convex but between -bend and bend: Newton's steps from there, or from where the ray comes near,
// close in on a root from one side and need no bracket. Two falling flanks may hold the first root:
// steps that leave the first have shown that it has none, and begin again on the second. From
// within the ring both flanks rise. The last step is on the form not multiplied out.
float robustTorus(vec3 ro, vec3 rd, float large, float small) {
    ro /= large;
    small /= large;
    float s = slideNear(ro, rd);
    s += slideNear(ro, rd);
    float ff = dot(ro, ro), room2 = square(1.0 + small) * kWiden - ff, room = sqrt(max(room2, 0.0));
    float dy = abs(rd.y) < kTiny ? kTiny : rd.y, mid = -ro.y / dy, reach = abs(kWiden * small / dy);
    float lo = max(max(-room, mid - reach), -s), hi = min(room, mid + reach);   // sphere and slab
    float k = ff + 1.0 - small * small, twice = 2.0 * length(ro.xz), b = dot(ro.xz, rd.xz);
    float p = 2.0 * k - 4.0 * dot(rd.xz, rd.xz), q = -8.0 * b, w = (k - twice) * (k + twice);
    float bend = sqrt(max(-p / 6.0, 0.0));
    bool within = torusAlong(ro, rd, small, lo).x < 0.0, again = !within && lo >= -bend;
    float second = within ? hi : max(bend, lo), t = within ? -bend : again ? second : lo;
    float limit = again ? hi : within ? bend : -bend, down = within ? -1.0 : 1.0;
    bool open = room2 > 0.0 && lo < hi, met = false;
    for (int i = 0; i < 32 && open; ++i) {
        float value = ((t * t + p) * t + q) * t + w, slope = (4.0 * t * t + 2.0 * p) * t + q;
        float next = t - value / slope;
        if (slope * down < 0.0 && next >= lo && next <= limit) {
            met = abs(next - t) < 1e-3;   // steps square their error
            open = !met;
            t = next;
        } else {
            open = !again;
            again = true;
            limit = hi;
            t = second;
        }
    }
    vec2 g = torusAlong(ro, rd, small, t);
    return met ? (s + t - g.x / (abs(g.y) < 1e-6 ? 1e-6 : g.y)) * large : -1.0;
}

// ---- Scene --------------------------------------------------------------------------------------
// Every shape has a frame of its own, in which it stands at the origin, upright; the ray is brought
// there. All are asked in turn, and the nearest answer ahead stays. What lies on the surface is
// then worked out once, for the winner: `settle` says where and how it faces.

vec3 inGem(vec3 v) {   // the crystal turns about a tilted axis
    v.xy = turn(v.xy, 0.35);
    v.xz = turn(v.xz, 2.0 * kPi * cycles(0.03125));
    return v;
}
vec3 outOfGem(vec3 v) {
    v.xz = turn(v.xz, -2.0 * kPi * cycles(0.03125));
    v.xy = turn(v.xy, -0.35);
    return v;
}
vec3 gemCentre() { return kRingCentre + vec3(0.0, 0.05 * sin(2.0 * kPi * cycles(0.125)), 0.0); }
float ringTurn() { return 0.3 + 0.3 * sin(2.0 * kPi * cycles(0.03125)); }
vec3 inRing(vec3 v) { return vec3(turn(v.xz, ringTurn()), v.y); }   // the ring's axis becomes y
vec3 outOfRing(vec3 v) { return vec3(turn(v.xy, -ringTurn()), v.z).xzy; }
vec3 inBox(vec3 v, float angle) { return vec3(turn(v.xz, angle), v.y).xzy; }

// Metres to world units and back.
vec3 toWorld(vec3 q) { return worldScale * q + worldPlace; }
vec3 toStudio(vec3 p) { return (p - worldPlace) / worldScale; }

vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}
// Does the ray meet the box before tMax? Far side widened by 2 ulp: rounding never loses a hit.
bool meetsBox(vec3 ro, vec3 inv, vec3 lo, vec3 hi, float tMax) {
    vec3 a = (lo - ro) * inv, b = (hi - ro) * inv;
    vec3 n = min(a, b), f = max(a, b);
    return max(max(n.x, n.y), max(n.z, 0.0)) <= min(min(f.x, f.y), min(f.z, tMax)) * 1.00000024;
}

void keepNearer(inout Hit h, float t, int id) {
    if (t > 0.0 && t < h.t) {
        h.t = t;
        h.id = id;
    }
}
void meetTriangle(vec3 ro, vec3 rd, mat3 corners, mat3 seen, float slid, inout float t,
                  inout mat3 met) {
    float found = robust ? slid + robustTriangle(seen[0], seen[1], seen[2])
        : textbookTriangle(ro, rd, corners[0], corners[1], corners[2]);
    if (found > 0.0 && found < t) {
        t = found;
        met = corners;
    }
}
vec3 gemCorner(int k, float side) {   // of an icosahedron: two rings of five
    vec2 ring = 0.894427191 * kFive[(side > 0.0 ? k : k + 3) % 5];
    return (kGemSize * worldScale * side) * vec3(ring, 0.447213595).xzy;
}
void meetGem(vec3 ro, vec3 rd, inout Hit h) {
    vec3 near = ro;
    float slid = slideNear(near, rd), size = kGemSize * worldScale;
    if (dot(near, near) > size * size * 1.01) return;
    Shear q = shearAlong(rd);
    vec3 pole = vec3(0.0, size, 0.0), a = gemCorner(0, 1.0), b = gemCorner(0, -1.0);
    vec3 poleS = sheared(pole - near, q), footS = sheared(-pole - near, q);
    vec3 aS = sheared(a - near, q), bS = sheared(b - near, q);
    // The rings close on the numbers that they began with: worked out again, they may be rounded
    // elsewhere, and the edge would leak.
    mat4x3 first = mat4x3(a, b, aS, bS);
    float t = h.t;
    mat3 met = mat3(1.0);
    for (int k = 1; k <= 5; ++k) {
        vec3 c = gemCorner(k, 1.0), d = gemCorner(k, -1.0);
        mat4x3 next = k == 5 ? first : mat4x3(c, d, sheared(c - near, q), sheared(d - near, q));
        c = next[0]; d = next[1];
        vec3 cS = next[2], dS = next[3];
        meetTriangle(ro, rd, mat3(pole, a, c), mat3(poleS, aS, cS), slid, t, met);
        meetTriangle(ro, rd, mat3(a, b, c), mat3(aS, bS, cS), slid, t, met);
        meetTriangle(ro, rd, mat3(b, d, c), mat3(bS, dS, cS), slid, t, met);
        meetTriangle(ro, rd, mat3(-pole, d, b), mat3(footS, dS, bS), slid, t, met);
        a = c;
        b = d;
        aS = cS;
        bS = dS;
    }
    if (t == h.t) return;
    if (robust)
        t = slid + exactDistance(sheared(met[0] - near, q), sheared(met[1] - near, q),
                                 sheared(met[2] - near, q));
    h = Hit(t, kGemId, cross(met[1] - met[0], met[2] - met[1]));
}
void meetSphere(vec3 ro, vec3 rd, vec4 ball, int id, inout Hit h) {
    ro -= toWorld(ball.xyz);
    float r = worldScale * ball.w;
    keepNearer(h, robust ? intersectSphere(ro, rd, vec3(0.0), r) : textbookSphere(ro, rd, r), id);
}
void meetDisc(vec3 ro, vec3 rd, vec3 centre, vec3 nor, float r, int id, inout Hit h) {
    ro -= toWorld(centre);
    r *= worldScale;
    keepNearer(h, robust ? robustDisc(ro, rd, nor, r) : textbookDisc(ro, rd, nor, r), id);
}
void meetBox(vec3 ro, vec3 rd, vec3 centre, vec3 halfSize, float angle, int id, inout Hit h) {
    ro = inBox(ro - toWorld(centre), angle);
    rd = inBox(rd, angle);
    halfSize *= worldScale;
    vec3 face;
    float t = robust ? robustBox(ro, rd, halfSize, face) : textbookBox(ro, rd, halfSize, face);
    if (t > 0.0 && t < h.t) h = Hit(t, id, face);
}

Hit meetScene(vec3 ro, vec3 rd) {
    Hit h = Hit(kFar, kWallId, vec3(0.0));
    float s = worldScale;
    // The room, whose walls are seen from inside only.
    vec3 f = ro - worldPlace;
    float slid = -dot(f.xz, rd.xz) / max(dot(rd.xz, rd.xz), 1e-12);
    vec2 l = f.xz + slid * rd.xz;
    float chord2 = max(square(kWall * s) - dot(l, l), 0.0);
    h.t = slid + sqrt(chord2 / max(dot(rd.xz, rd.xz), 1e-12));
    if (rd.y > 0.0) keepNearer(h, (kCeiling * s - f.y) / rd.y, kWallId);
    keepNearer(h, -f.y / (abs(rd.y) < kTiny ? kTiny : rd.y), kFloorId);
    meetDisc(ro, rd, kKey, unit(-kKey), keyRadius, kLampId, h);
    if (!meetsBox(f, safeInverse(rd), s * kStageLow, s * kStageHigh, h.t)) return h;

    meetSphere(ro, rd, kBall, kBallId, h);
    meetSphere(ro, rd, kChrome, kChromeId, h);
    meetSphere(ro, rd, kPearl, kPearlId, h);
    meetSphere(ro, rd, kBerry, kBerryId, h);
    meetBox(ro, rd, kPlinthCentre, kPlinthHalf, kPlinthTurn, kPlinthId, h);
    meetBox(ro, rd, kCubeCentre, kCubeHalf, kCubeTurn, kCubeId, h);
    meetDisc(ro, rd, kMirrorCentre, kMirrorNormal, kMirrorRadius, kMirrorId, h);
    meetDisc(ro, rd, kDrumCentre + vec3(0.0, kDrum.y, 0.0), vec3(0, 1, 0), kDrum.x, kDrumTopId, h);
    f = ro - toWorld(kDrumCentre);
    keepNearer(h, robust ? robustCylinder(f, rd, s * kDrum.x, s * kDrum.y)
        : textbookCylinder(f, rd, s * kDrum.x, s * kDrum.y), kDrumId);
    f = ro - toWorld(kConeApex);
    keepNearer(h, robust ? robustCone(f, rd, kCone.x, s * kCone.y)
        : textbookCone(f, rd, kCone.x, s * kCone.y), kConeId);
    f = ro - toWorld(kEggCentre);
    keepNearer(h, robust ? robustEllipsoid(f, rd, s * kEggAxes)
        : textbookEllipsoid(f, rd, s * kEggAxes), kEggId);
    f = inRing(ro - toWorld(kRingCentre));
    vec3 fd = inRing(rd);
    keepNearer(h, robust ? robustTorus(f, fd, s * kRing.x, s * kRing.y)
        : textbookTorus(f, fd, s * kRing.x, s * kRing.y), kRingId);
    meetGem(inGem(ro - toWorld(gemCentre())), inGem(rd), h);
    return h;
}

// Into the box by clamping, then out to the face that was met.
vec3 settleOnBox(Hit h, inout vec3 q) {
    bool cube = h.id == kCubeId;
    vec3 centre = cube ? kCubeCentre : kPlinthCentre, size = cube ? kCubeHalf : kPlinthHalf;
    float angle = cube ? kCubeTurn : kPlinthTurn;
    vec3 v = clamp(inBox(q - centre, angle), -size, size);
    q = centre + inBox(mix(v, size * h.face, abs(h.face)), -angle);
    return inBox(h.face, -angle);
}
// Moves a point near a surface, m, onto it; gives the outward normal.
vec3 settle(Hit h, inout vec3 q) {
    vec3 nor = vec3(0.0, 1.0, 0.0), v = q;
    vec4 ball = h.id == kBallId ? kBall : h.id == kChromeId ? kChrome
        : h.id == kPearlId ? kPearl : kBerry;
    if (h.id == kFloorId) {
        q.y = 0.0;
    } else if (h.id == kLampId) {
        nor = unit(-kKey);
        q -= dot(q - kKey, nor) * nor;
    } else if (h.id == kWallId) {
        v = unit(vec3(q.x, 0.0, q.z));
        bool above = q.y > kCeiling * 0.9999;
        nor = above ? vec3(0.0, -1.0, 0.0) : -v;
        q = above ? vec3(q.x, kCeiling, q.z) : vec3(kWall * v.x, q.y, kWall * v.z);
    } else if (h.id <= kBerryId) {
        nor = unit(q - ball.xyz);
        q = ball.xyz + ball.w * nor;
    } else if (h.id == kRingId) {
        v = inRing(q - kRingCentre);
        vec3 core = kRing.x * unit(vec3(v.x, 0.0, v.z));
        nor = unit(v - core);
        q = kRingCentre + outOfRing(core + kRing.y * nor);
        nor = outOfRing(nor);
    } else if (h.id == kGemId) {
        nor = outOfGem(unit(h.face));   // an icosahedron's faces are 0.79 as far out as its corners
        q += (0.794654472 * kGemSize - dot(q - gemCentre(), nor)) * nor;
    } else if (h.id == kEggId) {
        v = (q - kEggCentre) / kEggAxes;
        v = unit(v);
        q = kEggCentre + kEggAxes * v;
        nor = unit(v / kEggAxes);
    } else if (h.id == kDrumId) {
        nor = unit(vec3(q.x - kDrumCentre.x, 0.0, q.z - kDrumCentre.z));
        q.xz = kDrumCentre.xz + kDrum.x * nor.xz;
    } else if (h.id == kDrumTopId) {
        q.y = kDrumCentre.y + kDrum.y;
    } else if (h.id == kConeId) {
        v = unit(vec3(q.x - kConeApex.x, 0.0, q.z - kConeApex.z));
        nor = unit(v + vec3(0.0, kCone.x, 0.0));
        q -= dot(q - kConeApex, nor) * nor;
    } else if (h.id == kMirrorId) {
        nor = kMirrorNormal;
        q -= dot(q - kMirrorCentre, nor) * nor;
    } else {
        nor = settleOnBox(h, q);
    }
    return nor;
}

// Where a ray arrives, m, and the normal there. Far off the distance is rounded, and so was the ray
// in each shape's own frame: both are made good along the ray, near the surface.
vec3 arrive(vec3 ro, vec3 rd, Hit h, out vec3 q) {
    vec3 nor;
    q = toStudio(alongExactly(ro, rd, h.t));
    for (int k = h.t < 20.0 * worldScale ? 1 : 0; k < 2; ++k) {
        vec3 onto = q;
        nor = settle(h, onto);
        float speed = dot(rd, nor);
        q = k == 1 || abs(speed) < 0.1 ? onto : q + dot(onto - q, nor) / speed * rd;
    }
    return nor;
}

// ---- Light --------------------------------------------------------------------------------------
// A lamp is a disc. The cone from a point to it has the slope rim = radius / distance; how far the
// cone's axis passes from a shape, over the cone's width rim t there, says what share of the cone
// is free: one evaluation a shape instead of many rays. Free shares of several shapes multiply,
// which is right for shapes that do not overlap as seen from there; more, thinner cones make it
// exact.

// Share of a lamp's disc that a sphere leaves free; rim: slope of the disc's radius seen from ro.
float besideSphere(vec3 ro, vec3 rd, float rim, float tMax, vec4 s) {
    vec3 f = s.xyz - ro;
    float t = dot(f, rd), r = abs(s.w);
    float away = length(f - t * rd), disc = max(rim * t, 1e-6);
    float reach = smoothstep(0.0, 1.0, (r + disc - away) / (2.0 * min(r, disc)));
    float cover = t > 0.0 && t < tMax ? reach * min(1.0, square(r / disc)) : 0.0;
    return 1.0 - cover * (s.w < 0.0 ? 0.62 : 1.0);   // biased: glass dims, it does not focus
}
// The same for any shape, by how far the ray passes from its surface (negative: inside) at t.
float besideEdge(float away, float t, float rim, float tMax) {
    return t > 0.0 && t < tMax ? smoothstep(-1.0, 1.0, away / max(rim * t, 1e-6)) : 1.0;
}
float besideEllipsoid(vec3 ro, vec3 rd, float rim, float tMax, vec3 axes) {
    vec3 u = ro / axes, v = rd / axes;
    float t = -dot(u, v) / dot(v, v), reach;
    u += t * v;
    reach = max(length(u), 1e-6);
    return besideEdge((reach - 1.0) * reach / length(u / axes), t, rim, tMax);
}
// A solid |xz| <= r - slope y, |y| <= h: where the ray comes nearest to its side, or to its rim.
float besideRound(vec3 ro, vec3 rd, float rim, float tMax, float r, float slope, float h) {
    float dy = abs(rd.y) < kTiny ? kTiny : rd.y, a = dot(rd.xz, rd.xz) + 1e-12;
    vec2 ends = (vec2(-h, h) - ro.y) / dy;
    ends = max(vec2(min(ends.x, ends.y), max(ends.x, ends.y)), 0.0);
    if (ends.y <= 0.0) return 1.0;
    float n = slope * rd.y, t0 = -dot(ro.xz, rd.xz) / a, c = length(ro.xz + t0 * rd.xz);
    float best = t0 - n * c / sqrt(a * max(a - n * n, 1e-12));
    float t = clamp(best, ends.x, ends.y), y = ro.y + t * rd.y;
    float away = (length(ro.xz + t * rd.xz) - r + slope * y) * inversesqrt(1.0 + slope * slope);
    return besideEdge(t == best ? away : away * max(abs(rd.y), rim), t, rim, tMax);
}
float besideBox(vec3 ro, vec3 rd, float rim, float tMax, vec3 halfSize) {
    vec2 depth;   // entering less leaving: negative where the cone's axis passes through
    for (int k = 0; k < 2; ++k) {   // against the box shrunk and grown by the cone
        float grow = k == 0 ? -rim : rim, near = 0.0, far = tMax;
        for (int side = 0; side < 2; ++side) {
            vec3 speed = (side == 0 ? rd : -rd) - grow;
            speed = mix(speed, vec3(kTiny), lessThan(abs(speed), vec3(kTiny)));
            vec3 t = (halfSize - (side == 0 ? ro : -ro)) / speed;
            vec3 leave = mix(vec3(tMax), t, greaterThan(speed, vec3(0.0)));
            far = min(far, min(leave.x, min(leave.y, leave.z)));
            near = max(near, maxComponent(mix(t, vec3(0.0), greaterThan(speed, vec3(0.0)))));
        }
        depth[k] = near - far;
    }
    if (depth.y >= 0.0) return 1.0;
    if (depth.x <= 0.0) return 0.0;
    return smoothstep(0.0, 1.0, depth.x / max(depth.x - depth.y, 1e-9));
}
float ringDistance2(vec3 p) { return square(length(p.xz) - kRing.x) + p.y * p.y; }
float besideRing(vec3 ro, vec3 rd, float rim, float tMax) {
    float t0 = -dot(ro, rd), reach = kRing.x + kRing.y + max(rim * t0, 0.0);
    float w2 = reach * reach - dot(ro, ro) + t0 * t0;
    if (w2 <= 0.0 || t0 + sqrt(w2) <= 0.0) return 1.0;
    float h = sqrt(w2) / 6.0, best = t0, least = 1e9;
    for (int k = loopStart() - 5; k <= 5; k += 2) {   // the nearest of six, then parabolas
        float d2 = ringDistance2(ro + (t0 + h * float(k)) * rd);
        if (d2 < least) {
            least = d2;
            best = t0 + h * float(k);
        }
    }
    for (int k = loopStart(); k < 3; ++k) {
        float a = ringDistance2(ro + (best - h) * rd), b = ringDistance2(ro + (best + h) * rd);
        float bend = a - 2.0 * least + b, shift = bend > 1e-9 ? 0.5 * h * (a - b) / bend : 0.0;
        float next = clamp(best + shift, best - h, best + h);
        float d2 = ringDistance2(ro + next * rd);
        if (d2 < least) {
            least = d2;
            best = next;
        }
        h *= 0.35;
    }
    return besideEdge(sqrt(least) - kRing.y, best, rim, tMax);
}
float besideDisc(vec3 ro, vec3 rd, float rim, float tMax, vec3 nor, float r) {
    float speed = dot(rd, nor), t = -dot(ro, nor) / (abs(speed) < kTiny ? kTiny : speed);
    return besideEdge(length(ro + t * rd) - r, t, rim, tMax);
}

// Share of one sub-disc of a light that a point sees.
float seenShare(vec3 ro, vec3 rd, float rim, float tMax) {
    float free = besideSphere(ro, rd, rim, tMax, kBall * vec4(1, 1, 1, -1));
    free *= besideSphere(ro, rd, rim, tMax, kChrome);
    free *= besideSphere(ro, rd, rim, tMax, kPearl);
    free *= besideSphere(ro, rd, rim, tMax, kBerry);
    free *= besideSphere(ro, rd, rim, tMax, vec4(gemCentre(), -0.88 * kGemSize));
    free *= besideBox(inBox(ro - kPlinthCentre, kPlinthTurn), inBox(rd, kPlinthTurn), rim, tMax,
                      kPlinthHalf);
    float cube = besideBox(inBox(ro - kCubeCentre, kCubeTurn), inBox(rd, kCubeTurn), rim, tMax,
                           kCubeHalf);
    free *= mix(1.0, cube, 0.62);   // glass dims by as much as in besideSphere()
    free *= besideEllipsoid(ro - kEggCentre, rd, rim, tMax, kEggAxes);
    free *= besideRound(ro - kDrumCentre, rd, rim, tMax, kDrum.x, 0.0, kDrum.y);
    free *= besideRound(ro - kConeApex + vec3(0.0, 0.5 * kCone.y, 0.0), rd, rim, tMax,
                        0.5 * kCone.x * kCone.y, kCone.x, 0.5 * kCone.y);
    free *= besideRing(inRing(ro - kRingCentre), inRing(rd), rim, tMax);
    free *= besideDisc(ro - kMirrorCentre, rd, rim, tMax, kMirrorNormal, kMirrorRadius);
    return free;
}

// Light that a matt surface sends on, for an albedo of 1.
vec3 irradiance(vec3 q, vec3 nor, int id) {
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 2; ++k) {
        vec3 axis = (k == 0 ? kKey : kFill) - q;
        float spread = k == 0 ? keyRadius : kFillRadius;
        vec3 power = k == 0 ? 210.0 * keyPower * linearColour(keyColour)
            : 55.0 * fillPower * linearColour(fillColour);
        float far2 = dot(axis, axis), inverse = inversesqrt(far2), seen = dot(axis, nor) * inverse;
        // A large light rises and sets slowly.
        float half1 = spread * inverse;
        seen = seen > half1 ? seen : seen < -half1 ? 0.0 : square(seen + half1) / (4.0 * half1);
        if (seen <= 0.0) continue;
        if (shadows) {
            vec3 beside = abs(axis.y) * inverse > 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0);
            vec3 u = unit(cross(axis, beside)), v = cross(u, axis) * inverse;
            float sees = 0.0, size = spread / sqrt(float(shadowSamples));
            for (int j = 0; j < shadowSamples; ++j) {   // sub-discs on a phyllotaxis
                float a = 2.0 * kPi * kGolden * float(j);
                float r = (spread - size) * sqrt((float(j) + 0.5) / float(shadowSamples));
                vec3 to = axis + r * (u * cos(a) + v * sin(a));
                float far = length(to);
                sees += seenShare(liftOff(q, nor), to / far, size / far, far);
            }
            seen *= sees / float(shadowSamples);
        }
        if (!robust) {   // acne: what the textbooks' shadow ray meets on the surface it leaves
            vec3 away = axis * inverse;
            Hit h = meetScene(toWorld(q) + kTextbookLift * nor, away);
            if (h.id == id && h.t * inverse < worldScale) seen = 0.0;
        }
        sum += power * (seen / far2);
    }
    sum += 0.10 * fillPower * linearColour(fillColour) * (0.6 + 0.4 * nor.y);
    return sum;
}

// ---- Shading ------------------------------------------------------------------------------------
// A path splits in two at glass. Following both doubles the rays with each bounce, choosing one by
// chance is noisy: here the stronger goes on, and up to kPending weaker ones wait for its end.

// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}
// Inside of a rectangle, 1 to 0 over the last part `soft` of its half size; p in half sizes.
float panel(vec2 p, float soft) {
    vec2 inside = 1.0 - smoothstep(1.0 - soft, 1.0, abs(p));
    return inside.x * inside.y;
}
vec3 metal(vec3 tint, float cosine) { return mix(tint, vec3(1.0), pow(1.0 - cosine, 5.0)); }

// Coverage by one line of half-width h at distance x.
float oneLine(float x, float h, float w) {
    return clamp((min(x + 0.5 * w, h) - max(x - 0.5 * w, -h)) / max(w, 1e-4), 0.0, 1.0);
}
// Brass of the dial under a footprint w, longer along the ground by `slope` in direction rd.
float dial(vec2 p, vec2 slope, float w) {
    float rho = max(length(p), 1e-4), turns = atan(p.x, p.y + 1e-9) / (2.0 * kPi);
    vec2 out1 = p / rho;
    float wr = w * sqrt(1.0 + square(dot(slope, out1)));
    float wt = w * sqrt(1.0 + square(dot(slope, vec2(-out1.y, out1.x))));
    float sum = oneLine(rho - 3.30, 0.016, wr) + oneLine(rho - 3.38, 0.006, wr)
        + oneLine(rho - 2.70, 0.008, wr) + oneLine(rho - 0.9, 0.008, wr)
        + oneLine(rho - 0.84, 0.004, wr) + oneLine(rho - 1.8, 0.004, wr);
    float around = 2.0 * kPi * rho;
    float minor = lines(turns * 120.0, 0.003 * 120.0 / around, wt * 120.0 / around);
    float major = lines(turns * 24.0, 0.006 * 24.0 / around, wt * 24.0 / around);
    float spokes = lines(turns * 12.0, 0.004 * 12.0 / around, wt * 12.0 / around);
    sum += minor * oneLine(rho - 3.2, 0.1, wr) + major * oneLine(rho - 3.1, 0.2, wr)
        + spokes * oneLine(rho - 1.8, 0.9, wr);
    return min(sum, 1.0);
}

// What the studio's lamps paint on floor and walls besides the two that cast shadows.
vec3 gels(vec3 q) {
    vec3 warm = q - vec3(0.0, 0.9, -8.8), cool = q - vec3(6.0, 3.0, 6.0);
    return glow * (7.0 * linearColour(glowColour) * exp(-dot(warm, warm) / 12.0)
                   + vec3(0.3, 0.5, 1.2) * exp(-dot(cool, cool) / 30.0));
}
// Softboxes: two strips beside the set, one behind the camera, one above.
vec3 softboxes(vec3 q, vec3 nor, float w) {
    float soft = min(0.04 + w, 1.0);
    if (nor.y < -0.5)
        return 5.0 * fillPower * linearColour(fillColour)
            * panel((q.xz - kFill.xz) / kFillRadius, soft);
    float angle = atan(q.x, q.z + 1e-9);
    float left = panel(vec2((angle + 1.75) * kWall / 1.0, (q.y - 3.6) / 3.0), soft);
    float right = panel(vec2((angle - 1.60) * kWall / 0.7, (q.y - 3.6) / 3.0), soft);
    float front = panel(vec2((angle - 0.50) * kWall / 2.2, (q.y - 5.2) / 1.6), soft);
    return keyPower * (vec3(13.0, 8.0, 4.4) * left + vec3(4.0, 6.4, 11.0) * right
                       + vec3(6.0, 5.2, 4.4) * front);
}

// What a ray meets, as light sees it.
struct Surface {
    vec3 q, facing;       // place, m; the normal on the ray's side
    vec3 lit;             // the normal for light, where that is another
    vec3 mirror;          // share that goes on mirrored
    vec3 through;         // share that goes on behind the surface, along `behind`
    vec3 behind;
    vec3 albedo, shine;   // colour of what scatters; light of its own
    float cosine;         // between the ray and the normal
    float bend;           // curvature, 1/m: how fast a mirrored footprint spreads
    bool glassy, inside;
};

Surface surfaceAt(vec3 ro, vec3 rd, Hit h, bool within) {
    Surface s;
    vec3 p = ro + h.t * rd, onto = toStudio(p);
    s.q = onto;
    vec3 nor = robust ? arrive(ro, rd, h, s.q) : settle(h, onto);
    s.glassy = h.id == kBallId || h.id == kCubeId || h.id == kGemId;
    s.inside = s.glassy ? within : h.id == kMirrorId && dot(rd, nor) > 0.0;
    s.facing = s.inside ? -nor : nor;
    s.cosine = clamp(-dot(rd, s.facing), 0.0, 1.0);
    s.lit = s.facing;
    s.behind = rd;
    s.mirror = s.through = s.albedo = s.shine = vec3(0.0);
    s.bend = 0.0;
    return s;
}

// What glass leaves of light after t metres (Beer): its tint is that of a metre of the ball, of
// half a metre of the others.
vec3 glassLeft(int id, float t) {
    vec3 tint = linearColour(id == kGemId ? gemColour : glassColour);
    return pow(max(tint, 1e-4), vec3(t / (id == kBallId ? 1.0 : 0.5)));
}
void dressGlass(int id, vec3 rd, inout Surface s) {
    float eta = s.inside ? glassIndex : 1.0 / glassIndex;   // index before over index beyond
    s.mirror = vec3(fresnel(s.cosine, 1.0 / eta));
    s.through = 1.0 - s.mirror;
    s.behind = refractExactly(rd, s.facing, eta);
    s.bend = id == kBallId ? 1.0 / kBall.w : 0.0;
}

// Floor and wall are one sheet, bent where they meet, as in a photographer's studio; the dial lies
// on the floor's middle. w: footprint.
void dressStudio(int id, vec3 rd, float w, inout Surface s) {
    float rho = length(s.q.xz), arc = id == kWallId ? s.q.y : rho - kWall;
    float rise = smoothstep(-kCove, kCove, arc);
    if (s.facing.y > -0.5) {   // not the ceiling
        vec3 inward = -unit(vec3(s.q.x, 0.0, s.q.z));
        s.lit = unit(mix(vec3(0.0, 1.0, 0.0), inward, rise));
    }
    s.albedo = linearColour(studioColour) * 0.9;
    s.shine = s.albedo * gels(s.q);
    float stage = 1.0 - smoothstep(kDial - 0.5 * w, kDial + 0.5 * w + 0.001, rho);
    if (id == kFloorId && stage > 0.0) {
        float brass = inlay * dial(s.q.xz, rd.xz / max(abs(rd.y), 1e-4), w);
        float clear = fresnel(s.cosine, kIorVarnish);
        s.mirror = floorGloss * stage * mix(vec3(clear), vec3(0.45, 0.30, 0.13), 0.7 * brass);
        s.albedo = mix(s.albedo * mix(1.0, 0.55, stage), vec3(0.62, 0.36, 0.12), 0.8 * brass);
    } else {
        s.shine += softboxes(s.q, s.facing, w);
    }
}

// All else: metals mirror in their colour, glazed things are matt under a clear coat.
void dressSolid(int id, inout Surface s) {
    if (id == kChromeId) {
        s.mirror = metal(vec3(0.90, 0.92, 0.95), s.cosine);
        s.bend = 1.0 / kChrome.w;
    } else if (id == kRingId) {
        s.mirror = metal(linearColour(goldColour), s.cosine);
        s.bend = 1.0 / kRing.y;
    } else if (id == kMirrorId) {
        s.mirror = s.inside ? vec3(0.02) : vec3(0.88, 0.90, 0.90);
        s.albedo = s.inside ? vec3(0.03) : vec3(0.0);
    } else {
        s.albedo = id == kEggId ? vec3(0.80, 0.72, 0.62)
            : id == kPearlId ? vec3(0.85, 0.80, 0.74)
            : id == kBerryId ? vec3(0.60, 0.03, 0.05)
            : id == kConeId ? vec3(0.85, 0.42, 0.05)
            : id == kPlinthId ? vec3(0.05, 0.24, 0.28) : vec3(0.62, 0.26, 0.20);
        s.mirror = vec3(fresnel(s.cosine, kIorVarnish));
        s.bend = id == kPlinthId || id == kDrumTopId ? 0.0 : 2.5;
    }
}
void dress(int id, vec3 rd, float w, inout Surface s) {
    if (s.glassy) {
        dressGlass(id, rd, s);
    } else if (id == kLampId) {
        s.shine = (dot(rd, s.facing) > 0.0 ? 0.02 : 14.0) * keyPower * linearColour(keyColour);
    } else if (id <= kWallId) {
        dressStudio(id, rd, w, s);
    } else {
        dressSolid(id, s);
    }
}

// Where a ray goes on from, in world units, on the side that `side` points to. What the textbooks
// do, a fixed lift, is too little far from the origin and too much for a small world.
vec3 goOn(vec3 p, vec3 q, vec3 side) {
    return robust ? toWorld(liftOff(q, side)) : p + kTextbookLift * side;
}

// Light that arrives at ro (world) against rd. pixel: its width there, and what a unit of t adds.
vec3 lightAlong(vec3 ro, vec3 rd, vec2 pixel) {
    vec3 sum = vec3(0.0), share = vec3(1.0);
    vec3 laterRo[kPending], laterRd[kPending], laterShare[kPending];
    vec2 laterWidth[kPending], width = pixel;   // footprint: x + y t
    bool within = false, laterWithin[kPending];   // glass
    int pending = 0;
    for (int ray = 0; ray < bounces; ++ray) {
        Hit h = meetScene(ro, rd);
        vec3 p = ro + h.t * rd;
        float t = h.t / worldScale, w = width.x + width.y * t;
        Surface s = surfaceAt(ro, rd, h, within);
        if (s.glassy && s.inside) share *= glassLeft(h.id, t);
        dress(h.id, rd, w, s);
        if (maxComponent(share * s.albedo) > kLeastThroughput)
            s.shine += (1.0 - s.mirror) * s.albedo * irradiance(s.q, s.lit, h.id);
        sum += share * s.shine;

        // Two ways on: the stronger is followed, the other waits.
        vec3 nextRd = reflect(rd, s.facing);   // and above the surface, whatever was rounded
        nextRd = unit(nextRd + max(1e-4 - dot(nextRd, s.facing), 0.0) * s.facing);
        vec3 passed = share * s.through;
        vec3 raised = goOn(p, s.q, s.facing), sunk = goOn(p, s.q, -s.facing);
        share *= s.mirror;
        width = vec2(w, width.y + 2.0 * w * s.bend / max(s.cosine, 0.1));
        bool follow = maxComponent(passed) > maxComponent(share);
        vec3 other = follow ? share : passed;
        if (maxComponent(other) > kLeastThroughput && pending < kPending) {
            laterRo[pending] = follow ? raised : sunk;
            laterRd[pending] = follow ? nextRd : s.behind;
            laterShare[pending] = other;
            laterWidth[pending] = width;
            laterWithin[pending] = s.inside == follow && s.glassy;
            ++pending;
        }
        ro = follow ? sunk : raised;
        rd = follow ? s.behind : nextRd;
        share = follow ? passed : share;
        within = s.inside != follow && s.glassy;
        if (maxComponent(share) <= kLeastThroughput) {
            if (pending == 0) break;
            --pending;
            ro = laterRo[pending];
            rd = laterRd[pending];
            share = laterShare[pending];
            width = laterWidth[pending];
            within = laterWithin[pending];
        }
    }
    return sum;
}

// ---- Error of the hit distance ------------------------------------------------------------------
// How wrong is t? No reference is needed: the hit point, formed in twice the digits, lies off the
// surface by some gap; the gap over the ray's speed towards the surface is what t is out by. That
// is asked at the robust hit, near enough for a straight line to the surface to do. How far the
// textbook's t lies from that one is a difference of two numbers, and simply added.

vec3 heat(float x) {   // black, violet, red, orange, pale yellow; 0 to 1
    vec3 c = mix(vec3(0.0, 0.0, 0.02), vec3(0.10, 0.01, 0.25), smoothstep(0.0, 0.25, x));
    c = mix(c, vec3(0.55, 0.02, 0.16), smoothstep(0.2, 0.5, x));
    c = mix(c, vec3(1.0, 0.22, 0.01), smoothstep(0.45, 0.75, x));
    return mix(c, vec3(1.0, 0.95, 0.55), smoothstep(0.7, 1.0, x));
}
// Relative error of the distance to the first hit, as 1 + log10 / 8, or 2 for another object.
float distanceError(vec3 ro, vec3 rd) {
    Hit h = meetScene(ro, rd);
    bool chosen = robust;
    robust = true;
    Hit g = meetScene(ro, rd);
    robust = chosen;
    if (g.id != h.id) return 2.0;
    vec3 q = alongExactly(ro - worldPlace, rd, g.t) / worldScale, onto = q, nor = settle(g, onto);
    float speed = dot(rd, nor), left = dot(onto - q, nor) / (abs(speed) < 1e-4 ? 1e-4 : speed);
    float error = abs((h.t - g.t) - worldScale * left) / g.t;
    return 1.0 + log2(clamp(error, 1e-8, 1.0)) / (8.0 * log2(10.0));
}
vec3 errorView(vec3 ro, vec3 rd, vec2 uv) {   // uv: the picture's height is 1, its middle 0
    float error = distanceError(ro, rd);
    vec3 c = error > 1.5 ? vec3(0.0, 0.75, 0.65) : heat(error);
    vec2 bar = vec2(uv.x / 0.96 + 0.5, (uv.y + 0.44) / 0.014);   // the scale: a decade a step
    if (abs(bar.x - 0.5) < 0.51 && abs(bar.y + 0.7) < 2.6) c = vec3(0.015);
    if (abs(bar.x - 0.5) < 0.5 && abs(bar.y) < 1.0) c = heat(bar.x);
    // Exponents below it, from -8 to 0, in digits of 3 x 5 dots.
    int digits[9] = int[9](31727, 30866, 29679, 29671, 23524, 31207, 31183, 9879, 31599);
    float step1 = floor(bar.x * 8.0 + 0.5);
    vec2 dots = vec2((bar.x * 8.0 - step1) * 0.12, uv.y + 0.477) / 0.0035;
    ivec2 cell = ivec2(floor(dots)) + ivec2(1, 0);
    bool there = abs(step1 - 4.0) <= 4.0 && cell.x >= 0 && cell.x < 3 && cell.y >= 0 && cell.y < 5;
    if (there && (digits[int(step1)] >> (cell.y * 3 + cell.x) & 1) == 1) c = vec3(0.8);
    return c;
}

// ---- Image --------------------------------------------------------------------------------------
// `robust` is one branch for the whole pixel: specialised, the other formulas are not in the
// program. Where the eye steps back by `magnitude`, the lens grows as long, so that the picture
// stays.

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
    robust = intersector == 1 || (intersector == 2 && fragCoord.x >= wipe * iResolution.x);
    worldScale = magnify == 1 ? magnitude : 1.0;
    if (magnify == 2 && !robust) worldPlace = (magnitude - 1.0) * vec3(0.8, 0.36, 0.48);
    float stepBack = magnify == 0 ? magnitude : 1.0;

    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    float height = clamp(cameraHeight - 4.0 * orbit.y, 0.1, 8.0);
    vec3 eye = vec3(cameraDistance * sin(angle), height, cameraDistance * cos(angle));
    vec3 right = vec3(cos(angle), 0.0, -sin(angle));
    vec3 target = vec3(0.0, targetHeight, 0.0) + targetShift * right, forward = target - eye;
    float away = length(forward), lens = focalLength / 24.0;
    forward /= away;
    right = unit(cross(forward, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(right, forward), sum = vec3(0.0);
    float pixel = 1.0 / (lens * iResolution.y);
    for (int k = 0; k < antialiasing; ++k) {
        vec2 jitter = fract(0.5 + float(k) * vec2(0.754877666, 0.569840291)) - 0.5;
        vec2 uv = (fragCoord + jitter - 0.5 * iResolution.xy) / iResolution.y;
        vec3 across = (uv.x * right + uv.y * up) / lens;
        vec3 rd = unit(forward + across / stepBack);
        // The eye stands stepBack times as far; a robust ray starts where it nears the studio.
        float start = robust ? min(stepBack, 4.0) : stepBack;
        float nearer = away * (1.0 - start / stepBack);
        vec3 ro = target - away * start * forward + nearer * across;
        vec2 width = pixel * vec2(nearer, 1.0 / stepBack);
        sum += view == 1 ? errorView(toWorld(ro), rd, uv) : lightAlong(toWorld(ro), rd, width);
    }
    float gain = view == 1 ? 1.0 : exp2(exposure);
    vec3 shown = display(gain * sum / float(antialiasing));
    fragColor = vec4(shown + (view == 1 ? vec3(0.0) : dither(fragCoord)), 1.0);
}
