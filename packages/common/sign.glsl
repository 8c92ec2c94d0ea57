// What a material draws in place of a table that is not there: "NO SKIN TABLE", in letters of 3 by 5 cells.
#ifndef DERMIS_SIGN_GLSL
#define DERMIS_SIGN_GLSL

// The letter at this place of the text, 0 to 12: its cells as the bits of a number, the upper left one highest. 0: none.
float sign_letter(float place) {
    if (place < 1.0) return 27501.0;   // N
    if (place < 2.0) return 31599.0;   // O
    if (place < 3.0) return 0.0;
    if (place < 4.0) return 31183.0;   // S
    if (place < 5.0) return 23469.0;   // K
    if (place < 6.0) return 29847.0;   // I
    if (place < 7.0) return 27501.0;   // N
    if (place < 8.0) return 0.0;
    if (place < 9.0) return 29842.0;   // T
    if (place < 10.0) return 31725.0;  // A
    if (place < 11.0) return 27566.0;  // B
    if (place < 12.0) return 18727.0;  // L
    if (place < 13.0) return 31143.0;  // E
    return 0.0;
}

// 1 on the letters, 0 beside them. p: position on the screen in pixels, y downwards; the text repeats every 240 by 36.
float sign_of_missing_table(vec2 p) {
    vec2 cell = floor(fract(p / vec2(240.0, 36.0)) * vec2(60.0, 9.0));
    float column = cell.x - 4.0 * floor(cell.x / 4.0);
    if (column > 2.5 || cell.y > 4.5) return 0.0;
    float bit = 14.0 - 3.0 * cell.y - column;
    return 2.0 * fract(0.5 * floor((sign_letter(floor(cell.x / 4.0)) + 0.5) / exp2(bit)));
}

#endif
