/* before */ void /* the type */ mainImage /* the name */ ( // the brackets
    out /* // not the end */ vec4 c /**/ , in vec2 p /* "quotes" 'too' */ )
/***/ { // }
    c = vec4( 0.5 /* half */, /* { */ p.x / iResolution.x //* still
    , 0.25, 1./**/);
    c.b /*= 0.0*/ += 0.25; /* mainImage(out vec4 d, in vec2 q) */
} // uniform float x; //@ 1 [0, 1]
/* the end: /* does not nest */
