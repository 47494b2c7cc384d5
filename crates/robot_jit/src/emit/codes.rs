//! The instructions for each kind of registers.

use iced_x86::Code;

use super::{Shape, Vectors};
use crate::list::Binary;

/// An instruction for each shape: AVX2 on one number and on four, AVX-512 on one, four and eight.
pub(super) type Codes = [Code; 5];

/// Returns the instruction for a shape.
pub(super) fn code(codes: &Codes, shape: Shape) -> Code {
    codes[match (shape.vectors, shape.lanes) {
        (Vectors::Avx2, 1) => 0,
        (Vectors::Avx2, _) => 1,
        (Vectors::Avx512, 1) => 2,
        (Vectors::Avx512, 4) => 3,
        (Vectors::Avx512, _) => 4,
    }]
}

/// Returns the instructions of an operation on two values.
pub(super) fn binary(binary: Binary) -> &'static Codes {
    match binary {
        Binary::Add => &ADD,
        Binary::Sub => &SUB,
        Binary::Mul => &MUL,
        Binary::Div => &DIV,
        Binary::Min => &MIN,
        Binary::And => &AND,
        Binary::Or => &OR,
        Binary::Xor => &XOR,
        Binary::AddInteger => &ADD_INTEGER,
        Binary::SubInteger => &SUB_INTEGER,
        Binary::GreaterInteger => &GREATER_INTEGER,
    }
}

macro_rules! codes {
    ($($(#[$attribute:meta])* $name:ident: [$($code:ident),* $(,)?];)*) => {
        $($(#[$attribute])* pub(super) const $name: Codes = [$(Code::$code),*];)*
    };
}

codes! {
    ADD: [
        VEX_Vaddsd_xmm_xmm_xmmm64,
        VEX_Vaddpd_ymm_ymm_ymmm256,
        EVEX_Vaddsd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vaddpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vaddpd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    SUB: [
        VEX_Vsubsd_xmm_xmm_xmmm64,
        VEX_Vsubpd_ymm_ymm_ymmm256,
        EVEX_Vsubsd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vsubpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vsubpd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    MUL: [
        VEX_Vmulsd_xmm_xmm_xmmm64,
        VEX_Vmulpd_ymm_ymm_ymmm256,
        EVEX_Vmulsd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vmulpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vmulpd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    DIV: [
        VEX_Vdivsd_xmm_xmm_xmmm64,
        VEX_Vdivpd_ymm_ymm_ymmm256,
        EVEX_Vdivsd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vdivpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vdivpd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    MIN: [
        VEX_Vminsd_xmm_xmm_xmmm64,
        VEX_Vminpd_ymm_ymm_ymmm256,
        EVEX_Vminsd_xmm_k1z_xmm_xmmm64_sae,
        EVEX_Vminpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vminpd_zmm_k1z_zmm_zmmm512b64_sae,
    ];
    FMA_132: [
        VEX_Vfmadd132sd_xmm_xmm_xmmm64,
        VEX_Vfmadd132pd_ymm_ymm_ymmm256,
        EVEX_Vfmadd132sd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vfmadd132pd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vfmadd132pd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    FMA_213: [
        VEX_Vfmadd213sd_xmm_xmm_xmmm64,
        VEX_Vfmadd213pd_ymm_ymm_ymmm256,
        EVEX_Vfmadd213sd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vfmadd213pd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vfmadd213pd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    FMA_231: [
        VEX_Vfmadd231sd_xmm_xmm_xmmm64,
        VEX_Vfmadd231pd_ymm_ymm_ymmm256,
        EVEX_Vfmadd231sd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vfmadd231pd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vfmadd231pd_zmm_k1z_zmm_zmmm512b64_er,
    ];
    AND: [
        VEX_Vandpd_xmm_xmm_xmmm128,
        VEX_Vandpd_ymm_ymm_ymmm256,
        EVEX_Vandpd_xmm_k1z_xmm_xmmm128b64,
        EVEX_Vandpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vandpd_zmm_k1z_zmm_zmmm512b64,
    ];
    OR: [
        VEX_Vorpd_xmm_xmm_xmmm128,
        VEX_Vorpd_ymm_ymm_ymmm256,
        EVEX_Vorpd_xmm_k1z_xmm_xmmm128b64,
        EVEX_Vorpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vorpd_zmm_k1z_zmm_zmmm512b64,
    ];
    XOR: [
        VEX_Vxorpd_xmm_xmm_xmmm128,
        VEX_Vxorpd_ymm_ymm_ymmm256,
        EVEX_Vxorpd_xmm_k1z_xmm_xmmm128b64,
        EVEX_Vxorpd_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vxorpd_zmm_k1z_zmm_zmmm512b64,
    ];
    ADD_INTEGER: [
        VEX_Vpaddq_xmm_xmm_xmmm128,
        VEX_Vpaddq_ymm_ymm_ymmm256,
        EVEX_Vpaddq_xmm_k1z_xmm_xmmm128b64,
        EVEX_Vpaddq_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vpaddq_zmm_k1z_zmm_zmmm512b64,
    ];
    SUB_INTEGER: [
        VEX_Vpsubq_xmm_xmm_xmmm128,
        VEX_Vpsubq_ymm_ymm_ymmm256,
        EVEX_Vpsubq_xmm_k1z_xmm_xmmm128b64,
        EVEX_Vpsubq_ymm_k1z_ymm_ymmm256b64,
        EVEX_Vpsubq_zmm_k1z_zmm_zmmm512b64,
    ];
    // AVX-512 compares into mask registers, so the sign is spread instead.
    GREATER_INTEGER: [
        VEX_Vpcmpgtq_xmm_xmm_xmmm128,
        VEX_Vpcmpgtq_ymm_ymm_ymmm256,
        INVALID,
        INVALID,
        INVALID,
    ];
    SPREAD_SIGN: [
        INVALID,
        INVALID,
        EVEX_Vpsraq_xmm_k1z_xmmm128b64_imm8,
        EVEX_Vpsraq_ymm_k1z_ymmm256b64_imm8,
        EVEX_Vpsraq_zmm_k1z_zmmm512b64_imm8,
    ];
    SHIFT_LEFT: [
        VEX_Vpsllq_xmm_xmm_imm8,
        VEX_Vpsllq_ymm_ymm_imm8,
        EVEX_Vpsllq_xmm_k1z_xmmm128b64_imm8,
        EVEX_Vpsllq_ymm_k1z_ymmm256b64_imm8,
        EVEX_Vpsllq_zmm_k1z_zmmm512b64_imm8,
    ];
    // The instruction for one number has three operands.
    SQRT: [
        VEX_Vsqrtsd_xmm_xmm_xmmm64,
        VEX_Vsqrtpd_ymm_ymmm256,
        EVEX_Vsqrtsd_xmm_k1z_xmm_xmmm64_er,
        EVEX_Vsqrtpd_ymm_k1z_ymmm256b64,
        EVEX_Vsqrtpd_zmm_k1z_zmmm512b64_er,
    ];
    LOAD: [
        VEX_Vmovsd_xmm_m64,
        VEX_Vmovupd_ymm_ymmm256,
        EVEX_Vmovsd_xmm_k1z_m64,
        EVEX_Vmovupd_ymm_k1z_ymmm256,
        EVEX_Vmovupd_zmm_k1z_zmmm512,
    ];
    // Constants; for AVX2, all lanes are in memory.
    SPREAD: [
        VEX_Vmovsd_xmm_m64,
        VEX_Vmovupd_ymm_ymmm256,
        EVEX_Vmovsd_xmm_k1z_m64,
        EVEX_Vbroadcastsd_ymm_k1z_xmmm64,
        EVEX_Vbroadcastsd_zmm_k1z_xmmm64,
    ];
    STORE: [
        VEX_Vmovsd_m64_xmm,
        VEX_Vmovupd_ymmm256_ymm,
        EVEX_Vmovsd_m64_k1_xmm,
        EVEX_Vmovupd_ymmm256_k1z_ymm,
        EVEX_Vmovupd_zmmm512_k1z_zmm,
    ];
    COPY: [
        VEX_Vmovapd_xmm_xmmm128,
        VEX_Vmovapd_ymm_ymmm256,
        EVEX_Vmovapd_xmm_k1z_xmmm128,
        EVEX_Vmovapd_ymm_k1z_ymmm256,
        EVEX_Vmovapd_zmm_k1z_zmmm512,
    ];
}
