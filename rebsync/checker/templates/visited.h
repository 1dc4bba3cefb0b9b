/* States packed into words, and the set of those that were seen. */
#ifndef REBSYNC_VISITED_H
#define REBSYNC_VISITED_H

#include "search.h"

static inline uint64_t *words_of(struct search *s, uint64_t state)
{
    return (uint64_t *)s->states.data + state * s->words;
}

/* Whether the numbers of a state fit their fields. */
static int fits(struct search *s, const uint32_t *ids)
{
    for (uint32_t r = 0; r < s->rebecs; r++)
        if (ids[r] > s->fields[r].mask)
            return 0;
    return 1;
}

/* Packs a state; fields lie one behind the other. */
static inline void pack(struct search *s, const uint32_t *ids, uint64_t *words)
{
    uint64_t word = 0;
    uint32_t at = 0;
    for (uint32_t r = 0; r < s->rebecs; r++) {
        const struct field *f = s->fields + r;
        if (f->word > at) {
            words[at++] = word;
            word = 0;
        }
        word |= (uint64_t)ids[r] << f->shift;
        if (f->shift + f->width > 64) {
            words[at++] = word;
            word = (uint64_t)ids[r] >> (64 - f->shift);
        }
    }
    words[at] = word;
}

static inline void unpack_fields(const struct field *fields, uint32_t rebecs, const uint64_t *words, uint32_t *ids)
{
    for (uint32_t r = 0; r < rebecs; r++) {
        const struct field *f = fields + r;
        uint64_t value = words[f->word] >> f->shift;
        if (f->shift + f->width > 64)
            value |= words[f->word + 1] << (64 - f->shift);
        ids[r] = (uint32_t)(value & f->mask);
    }
}

static inline void unpack(struct search *s, const uint64_t *words, uint32_t *ids)
{
    unpack_fields(s->fields, s->rebecs, words, ids);
}

static inline uint64_t hash_words(struct search *s, const uint64_t *words)
{
    uint64_t hash = mixed(words[0], UINT64_C(0xE7037ED1A0B428DB));
    for (uint32_t w = 1; w < s->words; w++)
        hash = mixed(hash, words[w]);
    return hash;
}

/* --- the table of those seen: numbers from 1 on, with some bits of the hash above them */

static inline uint64_t slot_of(struct search *s, uint64_t hash)
{
    return (uint64_t)(((unsigned __int128)hash * s->slots) >> 64);
}

static inline uint32_t tag_of(struct search *s, uint64_t hash)
{
    return (uint32_t)((uint64_t)(uint32_t)hash << s->number_bits);
}

/* Lets the slot of a state be on its way. */
static inline uint64_t hash_ahead(struct search *s, const uint64_t *words)
{
    uint64_t hash = hash_words(s, words);
    if (s->slots)
        __builtin_prefetch(s->table + slot_of(s, hash), 1);
    return hash;
}

/* A batch with room for so many steps, however wide fields become. */
static struct batch make_batch(struct search *s, uint32_t steps)
{
    struct batch made = {malloc(steps * sizeof *made.steps), NULL, 0};
    made.words = malloc(steps * (s->rebecs / 2 + 1) * sizeof *made.words);
    if (made.steps && made.words)
        return made;
    free(made.steps);
    free(made.words);
    give_up(s->escape);
}

static void free_batch(struct batch *b)
{
    free(b->steps);
    free(b->words);
}

static void make_table(struct search *s, uint64_t slots)
{
    free(s->table);
    s->table = NULL;
    s->table = zeroed(s->escape, slots, sizeof *s->table);
    s->slots = slots;
    s->number_bits = 1;
    while (s->number_bits < 32 && slots >> s->number_bits)
        s->number_bits++;
}

/* Puts all states into a new table; some are on their way to it while others are hashed. */
static void fill_table(struct search *s, uint64_t slots)
{
    enum { AHEAD = 16 };
    uint64_t hashes[AHEAD];
    make_table(s, slots);
    for (uint64_t state = 0; state < s->count + AHEAD; state++) {
        if (state >= AHEAD) {
            uint64_t hash = hashes[state % AHEAD], at = slot_of(s, hash);
            while (s->table[at])
                at = at + 1 == s->slots ? 0 : at + 1;
            s->table[at] = tag_of(s, hash) | (uint32_t)(state - AHEAD + 1);
        }
        if (state < s->count) {
            hashes[state % AHEAD] = hash_words(s, words_of(s, state));
            __builtin_prefetch(s->table + slot_of(s, hashes[state % AHEAD]), 1);
        }
    }
}

static void room_for_state(struct search *s)
{
    if (s->count >= NONE - 2)
        give_up(s->escape);
    if (!s->compact && 10 * (s->count + 1) >= 6 * s->slots)
        fill_table(s, s->slots ? 2 * s->slots : SLOTS);
}

/* The slot of a state, or the free one where it would be. */
static inline uint64_t find(struct search *s, const uint64_t *words, uint64_t hash)
{
    uint64_t at = slot_of(s, hash);
    uint32_t tag = tag_of(s, hash), entry;
    uint32_t numbers = (uint32_t)((UINT64_C(1) << s->number_bits) - 1);
    for (; (entry = s->table[at]); at = at + 1 == s->slots ? 0 : at + 1) {
        if ((entry ^ tag) & ~numbers)
            continue;
        const uint64_t *known = words_of(s, (entry & numbers) - 1);
        uint32_t w = 0;
        while (w < s->words && known[w] == words[w])
            w++;
        if (w == s->words)
            break;
    }
    return at;
}

/* Whether local states make up the state of a number. */
static int is_state(struct search *s, const uint32_t *ids, int64_t state)
{
    if (!fits(s, ids))
        return 0;
    pack(s, ids, s->batch.words);
    return !memcmp(s->batch.words, words_of(s, (uint64_t)state), s->words * sizeof(uint64_t));
}

/* --- the layout of states */

/* Gives each rebec bits for the local states it has; what is left over is spread. */
static void lay_out(struct search *s, struct field *fields, uint32_t *words)
{
    uint32_t total = 0;
    for (uint32_t r = 0; r < s->rebecs; r++) {
        uint32_t width = 1;
        while (width < 32 && ((uint64_t)kernel_locals(s->kernel, r) + 1) >> width)
            width++;
        fields[r].width = width;
        total += width;
    }
    *words = (total + 63) / 64;
    for (uint32_t spare = *words * 64 - total, r = 0, full = 0; spare && full < s->rebecs;) {
        full = fields[r].width < 32 ? 0 : full + 1;
        if (fields[r].width < 32) {
            fields[r].width++;
            spare--;
        }
        r = (r + 1) % s->rebecs;
    }
    for (uint32_t r = 0, bit = 0; r < s->rebecs; bit += fields[r++].width) {
        fields[r].word = bit / 64;
        fields[r].shift = bit % 64;
        fields[r].mask = (UINT64_C(1) << fields[r].width) - 1;
    }
}

/* Told by the kernel of a new local state. */
static void meet(void *search, uint32_t rebec, uint32_t number)
{
    struct search *s = search;
    if (number > s->fields[rebec].mask)
        s->wide = 1;
}

/* Packs states anew in new fields: from the last one when they grow, else from the first. */
static void repack_all(struct search *s, struct vector *packed, uint64_t count, struct field *fields,
                       uint32_t words)
{
    struct field *before = s->fields;
    uint32_t old = s->words;
    uint64_t *data = room_for(s->escape, packed, (count + 1) * words * sizeof *data, 1);
    for (uint64_t i = 0; i < count; i++) {
        uint64_t state = words > old ? count - 1 - i : i;
        s->fields = before;
        s->words = old;
        unpack(s, data + state * old, s->unpacked);
        s->fields = fields;
        s->words = words;
        pack(s, s->unpacked, data + state * words);
    }
    s->fields = before;
    s->words = old;
}

/* Gives all states wider fields. */
static void repack(struct search *s)
{
    struct field *fields = zeroed(s->escape, s->rebecs, sizeof *fields);
    struct states *head = &s->frontier.head, *tail = &s->frontier.tail;
    uint32_t words;
    lay_out(s, fields, &words);
    repack_all(s, &s->states, s->compact ? 0 : s->count, fields, words);
    repack_all(s, &head->packed, head->count, fields, words);
    repack_all(s, &tail->packed, tail->count, fields, words);
    free(s->fields);
    s->fields = fields;
    s->words = words;
    s->wide = 0;
    if (!s->compact)
        fill_table(s, s->slots ? s->slots : SLOTS);
}

#endif
