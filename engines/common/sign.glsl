// What a material draws in place of what is not there: "NO SKIN TABLE", "NO CURVATURE", and where the engine has changed beneath it:
// "ENGINE CHANGED". Letters of 3 by 5 cells.
#ifndef DERMIS_SIGN_GLSL
#define DERMIS_SIGN_GLSL

// The letter at this place of the text, from 0: its cells as the bits of a number, the upper left one highest. 0: none.
float letter_of_missing_table(float place) {
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

float letter_of_missing_curvature(float place) {
    if (place < 1.0) return 27501.0;   // N
    if (place < 2.0) return 31599.0;   // O
    if (place < 3.0) return 0.0;
    if (place < 4.0) return 31015.0;   // C
    if (place < 5.0) return 23407.0;   // U
    if (place < 6.0) return 31661.0;   // R
    if (place < 7.0) return 23402.0;   // V
    if (place < 8.0) return 31725.0;   // A
    if (place < 9.0) return 29842.0;   // T
    if (place < 10.0) return 23407.0;  // U
    if (place < 11.0) return 31661.0;  // R
    if (place < 12.0) return 31143.0;  // E
    return 0.0;
}

float letter_of_changed_engine(float place) {
    if (place < 1.0) return 31143.0;   // E
    if (place < 2.0) return 27501.0;   // N
    if (place < 3.0) return 31087.0;   // G
    if (place < 4.0) return 29847.0;   // I
    if (place < 5.0) return 27501.0;   // N
    if (place < 6.0) return 31143.0;   // E
    if (place < 7.0) return 0.0;
    if (place < 8.0) return 31015.0;   // C
    if (place < 9.0) return 23533.0;   // H
    if (place < 10.0) return 31725.0;  // A
    if (place < 11.0) return 27501.0;  // N
    if (place < 12.0) return 31087.0;  // G
    if (place < 13.0) return 31143.0;  // E
    if (place < 14.0) return 27502.0;  // D
    return 0.0;
}

// The text repeats every 240 by 36 pixels, which are 60 by 9 cells; a letter takes 4 by 6. p: position on the screen in
// pixels, y downwards.
vec2 sign_cell(vec2 p) { return floor(fract(p / vec2(240.0, 36.0)) * vec2(60.0, 9.0)); }

// Whether a letter covers this cell: 0 or 1.
float is_on_letter(float letter, vec2 cell) {
    float column = cell.x - 4.0 * floor(cell.x / 4.0);
    if (column > 2.5 || cell.y > 4.5) return 0.0;
    float bit = 14.0 - 3.0 * cell.y - column;
    return 2.0 * fract(0.5 * floor((letter + 0.5) / exp2(bit)));
}

// 1 on the letters, 0 beside them.
float sign_of_missing_table(vec2 p) {
    vec2 cell = sign_cell(p);
    return is_on_letter(letter_of_missing_table(floor(cell.x / 4.0)), cell);
}

float sign_of_missing_curvature(vec2 p) {
    vec2 cell = sign_cell(p);
    return is_on_letter(letter_of_missing_curvature(floor(cell.x / 4.0)), cell);
}

float sign_of_changed_engine(vec2 p) {
    vec2 cell = sign_cell(p);
    return is_on_letter(letter_of_changed_engine(floor(cell.x / 4.0)), cell);
}

#endif
