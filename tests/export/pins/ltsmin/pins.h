/* The part of LTSmin's public header ltsmin/pins.h, and of those that it includes, that language
 * modules of rebsync use: the same names, types and layouts (LTSmin 3.1). host.c is behind it. */
#ifndef GREYBOX_H
#define GREYBOX_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* chunk_support.h */
typedef uint32_t chunk_len;
typedef struct {
    chunk_len len;
    char *data;
} chunk;
#define chunk_str(s) ((chunk){(chunk_len)strlen(s), ((char *)s)})
#define chunk_ld(l, d) ((chunk){l, d})

/* bitvector.h and dm.h */
typedef struct bitvector {
    size_t n_bits;
    size_t n_words;
    size_t *data;
} bitvector_t;
typedef struct {
    int size;
    struct header_entry *data;
    int *count;
    int *min;
    int *max;
} matrix_header_t;
typedef struct matrix {
    int rows;
    int cols;
    int bits_per_row;
    matrix_header_t row_perm;
    matrix_header_t col_perm;
    bitvector_t bits;
} matrix_t;
extern void dm_create(matrix_t *m, const int rows, const int cols);
extern void dm_set(matrix_t *m, const int row, const int col);

/* lts-type.h */
typedef struct lts_type_s *lts_type_t;
typedef enum {
    LTStypeDirect,
    LTStypeRange,
    LTStypeChunk,
    LTStypeEnum,
    LTStypeBool,
    LTStypeTrilean,
    LTStypeSInt32,
} data_format_t;
extern lts_type_t lts_type_create();
extern void lts_type_set_state_length(lts_type_t t, int length);
extern void lts_type_set_state_name(lts_type_t t, int idx, const char *name);
extern void lts_type_set_state_typeno(lts_type_t t, int idx, int typeno);
extern void lts_type_set_state_label_count(lts_type_t t, int count);
extern void lts_type_set_state_label_name(lts_type_t t, int label, const char *name);
extern void lts_type_set_state_label_typeno(lts_type_t t, int label, int typeno);
extern void lts_type_set_edge_label_count(lts_type_t t, int count);
extern void lts_type_set_edge_label_name(lts_type_t t, int label, const char *name);
extern void lts_type_set_edge_label_typeno(lts_type_t t, int label, int typeno);
extern int lts_type_put_type(lts_type_t t, const char *name, data_format_t format, int *is_new);
extern int lts_type_find_type(lts_type_t t, const char *name);
extern void lts_type_validate(lts_type_t t);

/* pins.h */
typedef struct grey_box_model *model_t;
typedef struct transition_info {
    int *labels;
    int group;
    int por_proviso;
} transition_info_t;
#define GB_TI(A, B) {(A), (B), 0}
typedef void (*TransitionCB)(void *context, transition_info_t *transition_info, int *dst, int *cpy);
typedef int (*next_method_grey_t)(model_t self, int group, int *src, TransitionCB cb,
                                  void *user_context);
typedef int (*get_label_method_t)(model_t self, int label, int *src);
extern void GBsetContext(model_t model, void *context);
extern void *GBgetContext(model_t model);
extern void GBsetLTStype(model_t model, lts_type_t info);
extern void GBsetDMInfo(model_t model, matrix_t *dm_info);
extern void GBsetStateLabelInfo(model_t model, matrix_t *sl_info);
extern void GBsetInitialState(model_t model, int *state);
extern void GBsetNextStateLong(model_t model, next_method_grey_t method);
extern void GBsetStateLabelLong(model_t model, get_label_method_t method);

#endif
