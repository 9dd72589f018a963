// Where a comment begins and ends: /* not here
//* nor here
/*/ this one is open until here */
void mainImage(out vec4 o, in vec2 p) {
    float a = 4.0 //* 2.0
    / 8.0 /**/ + 0.1; /* // */ a += 0.1; // */ a += 0.2;
    float b = 6.0 /* one */ / /* two */ 12.0;
    /***/ a *= 0.9; /* * / * */
    o = vec4(a, b * p.y / iResolution.y, p.x / iResolution.x, 1.0);
}
