/* States packed into words, and the set of those that were seen. */
#ifndef REBSYNC_VISITED_H
#define REBSYNC_VISITED_H

#include "components.h"

static inline uint64_t *words_of(struct engine *e, uint64_t state)
{
    return (uint64_t *)e->states.data + (state - e->forgotten) * e->words;
}

static inline void pack(struct engine *e, const uint32_t *ids, uint64_t *words)
{
    for (uint32_t w = 0; w < e->words; w++)
        words[w] = 0;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        const struct field *f = e->fields + r;
        words[f->word] |= (uint64_t)ids[r] << f->shift;
        if (f->shift + f->width > 64)
            words[f->word + 1] |= (uint64_t)ids[r] >> (64 - f->shift);
    }
}

static inline void unpack(struct engine *e, const uint64_t *words, uint32_t *ids)
{
    for (uint32_t r = 0; r < e->rebecs; r++) {
        const struct field *f = e->fields + r;
        uint64_t value = words[f->word] >> f->shift;
        if (f->shift + f->width > 64)
            value |= words[f->word + 1] << (64 - f->shift);
        ids[r] = (uint32_t)(value & f->mask);
    }
}

static inline uint64_t hash_words(struct engine *e, const uint64_t *words)
{
    uint64_t hash = mixed(words[0], UINT64_C(0xE7037ED1A0B428DB));
    for (uint32_t w = 1; w < e->words; w++)
        hash = mixed(hash, words[w]);
    return hash;
}

/* --- the table of those seen: numbers from 1 on, with some bits of the hash above them */

static inline uint64_t slot_of(struct engine *e, uint64_t hash)
{
    return (uint64_t)(((unsigned __int128)hash * e->slots) >> 64);
}

static inline uint32_t tag_of(struct engine *e, uint64_t hash)
{
    return (uint32_t)((uint64_t)(uint32_t)hash << e->number_bits);
}

static void make_table(struct engine *e, uint64_t slots)
{
    free(e->table);
    e->table = NULL;
    e->table = zeroed(e, slots, sizeof *e->table);
    e->slots = slots;
    e->number_bits = 1;
    while (e->number_bits < 32 && slots >> e->number_bits)
        e->number_bits++;
}

/* Puts all states into a new table; some are on their way to it while others are hashed. */
static void fill_table(struct engine *e, uint64_t slots)
{
    enum { AHEAD = 16 };
    uint64_t hashes[AHEAD];
    make_table(e, slots);
    for (uint64_t state = 0; state < e->count + AHEAD; state++) {
        if (state >= AHEAD) {
            uint64_t hash = hashes[state % AHEAD], at = slot_of(e, hash);
            while (e->table[at])
                at = at + 1 == e->slots ? 0 : at + 1;
            e->table[at] = tag_of(e, hash) | (uint32_t)(state - AHEAD + 1);
        }
        if (state < e->count) {
            hashes[state % AHEAD] = hash_words(e, words_of(e, state));
            __builtin_prefetch(e->table + slot_of(e, hashes[state % AHEAD]), 1);
        }
    }
}

static void room_for_state(struct engine *e)
{
    if (e->count >= NONE - 2)
        give_up(e);
    if (!e->compact && 10 * (e->count + 1) >= 6 * e->slots)
        fill_table(e, e->slots ? 2 * e->slots : SLOTS);
}

/* The slot of a state, or the free one where it would be. */
static inline uint64_t find(struct engine *e, const uint64_t *words, uint64_t hash)
{
    uint64_t at = slot_of(e, hash);
    uint32_t tag = tag_of(e, hash), entry;
    uint32_t numbers = (uint32_t)((UINT64_C(1) << e->number_bits) - 1);
    for (; (entry = e->table[at]); at = at + 1 == e->slots ? 0 : at + 1) {
        if ((entry ^ tag) & ~numbers)
            continue;
        const uint64_t *known = words_of(e, (entry & numbers) - 1);
        uint32_t w = 0;
        while (w < e->words && known[w] == words[w])
            w++;
        if (w == e->words)
            break;
    }
    return at;
}

/* Whether components make up the state of a number. */
static int is_state(struct engine *e, const uint32_t *ids, int64_t state)
{
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (ids[r] > e->fields[r].mask)
            return 0;
    pack(e, ids, e->batch_words);
    return !memcmp(e->batch_words, words_of(e, (uint64_t)state), e->words * sizeof(uint64_t));
}

/* The number of a state that was seen, or -1. */
static int64_t seen(struct engine *e, const uint32_t *ids)
{
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (ids[r] > e->fields[r].mask)
            return -1;
    pack(e, ids, e->batch_words);
    uint64_t at = find(e, e->batch_words, hash_words(e, e->batch_words));
    uint32_t numbers = (uint32_t)((UINT64_C(1) << e->number_bits) - 1);
    return e->table[at] ? (int64_t)(e->table[at] & numbers) - 1 : -1;
}

/* --- the layout of states */

/* Gives each rebec bits for the components it has; what is left over is spread. */
static void lay_out(struct engine *e, struct field *fields, uint32_t *words)
{
    uint32_t total = 0;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        uint32_t width = 1;
        while (width < 32 && (e->actors[r].components.count + 1) >> width)
            width++;
        fields[r].width = width;
        total += width;
    }
    *words = (total + 63) / 64;
    for (uint32_t spare = *words * 64 - total, r = 0, full = 0; spare && full < e->rebecs;) {
        full = fields[r].width < 32 ? 0 : full + 1;
        if (fields[r].width < 32) {
            fields[r].width++;
            spare--;
        }
        r = (r + 1) % e->rebecs;
    }
    for (uint32_t r = 0, bit = 0; r < e->rebecs; bit += fields[r++].width) {
        fields[r].word = bit / 64;
        fields[r].shift = bit % 64;
        fields[r].mask = (UINT64_C(1) << fields[r].width) - 1;
    }
}

/* Packs all states anew: from the last one when they grow, else from the first. */
static void repack(struct engine *e)
{
    struct field *fields = zeroed(e, e->rebecs, sizeof *fields), *before = e->fields;
    uint32_t words, old = e->words;
    uint64_t kept = e->count - e->forgotten;
    lay_out(e, fields, &words);
    room_for(e, &e->states, (kept + 1) * words * sizeof(uint64_t), 1);
    uint64_t *batch = realloc(e->batch_words, BATCH * words * sizeof *batch);
    if (!batch)
        give_up(e);
    e->batch_words = batch;
    uint64_t *data = (uint64_t *)e->states.data;
    for (uint64_t i = 0; i < kept; i++) {
        uint64_t state = words > old ? kept - 1 - i : i;
        e->fields = before;
        e->words = old;
        unpack(e, data + state * old, e->unpacked);
        e->fields = fields;
        e->words = words;
        pack(e, e->unpacked, data + state * words);
    }
    e->fields = fields;
    e->words = words;
    free(before);
    e->wide = 0;
    if (!e->compact)
        fill_table(e, e->slots ? e->slots : SLOTS);
}

#endif
