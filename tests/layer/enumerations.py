"""The enumerations of motion-layer 2 as they stand there: base, and members with their numbers."""

from typing import Final

TABLES: Final = {
    "E_PROGRESS": (
        "UINT",
        """
        PROGRESS_INVALID=0 PROGRESS_NOT_EXIST=100 PROGRESS_INIT=1000 PROGRESS_BUSY=2000
        PROGRESS_PREPARE=3000 PROGRESS_STARTUP=4000 PROGRESS_CHECK=5000 PROGRESS_OCCUPIED=6000
        PROGRESS_WORKING=7000 PROGRESS_STILL_WORKING=8000 PROGRESS_ERROR=9000 PROGRESS_DONE=10000
        """,
    ),
    "E_AXIS_CTRL": (
        "UINT",
        """
        AXIS_NULL=0 AXIS_INIT=1 AXIS_DISABLE=2 AXIS_ENABLE=3 AXIS_IDLE=10 AXIS_HOME=11
        AXIS_MOVE_POS=12 AXIS_MOVE_VELO=13 AXIS_HALT=14 AXIS_STOP=15 AXIS_SEND_TO_POS=16
        AXIS_RESET=19 AXIS_STARTUP=20 AXIS_MOVE_BUFFER=30 AXIS_MOVE_BUFFER_VELO=31
        AXIS_PARAMETER_READ=40 AXIS_PARAMETER_WRITE=41 AXIS_PARAMETER_WRITE_PERSISTENT=42
        AXIS_GEAR_IN=50 AXIS_GEAR_OUT=51 AXIS_GEAR_IN_MULTIMASTER=52 CAM_INIT=60 CAM_IN=61
        CAM_OUT=62 CAM_SCALING=63 CAM_INFO=64 CAM_RD_MOTION_FUNCTION=65
        CAM_RD_MOTION_FUNCTION_POINT=66 CAM_RD_MOTION_FUNCTIONS_VALUES=67 CAM_WRT_MOTION_FUNCTION=68
        CAM_WRT_MOTION_FUNCTION_POINT=69 FLY_GEAR_IN_POS=70 FLY_GEAR_IN_VELO=71
        """,
    ),
    "E_AXIS_STATE": (
        "UINT",
        """
        AXIS_NULL=0 AXIS_INIT=1 AXIS_DISABLE=2 AXIS_ENABLE=3 AXIS_NO_INIT=9 AXIS_IDLE=10
        AXIS_HOME=11 AXIS_MOVE_POS=12 AXIS_MOVE_VELO=13 AXIS_HALT=14 AXIS_STOP=15
        AXIS_SEND_TO_POS=16 AXIS_RESET=19 AXIS_STARTUP=20 AXIS_MOVE_BUFFER=30
        AXIS_MOVE_BUFFER_VELO=31 AXIS_PARAMETER_READ=40 AXIS_PARAMETER_WRITE=41
        AXIS_PARAMETER_WRITE_PERSISTENT=42 AXIS_GEAR_IN=50 AXIS_GEAR_OUT=51
        AXIS_GEAR_IN_MULTIMASTER=52 CAM_INIT=60 CAM_IN=61 CAM_OUT=62 CAM_SCALING=63 CAM_INFO=64
        CAM_RD_MOTION_FUNCTION=65 CAM_RD_MOTION_FUNCTION_POINT=66 CAM_RD_MOTION_FUNCTIONS_VALUES=67
        CAM_WRT_MOTION_FUNCTION=68 CAM_WRT_MOTION_FUNCTION_POINT=69 FLY_GEAR_IN_POS=70
        FLY_GEAR_IN_VELO=71
        """,
    ),
    "E_NCI_CTRL": (
        "UINT",
        """
        NULL=0 INIT=1 IDLE=2 RESET=3 LOAD_PROG=4 FEED_TABLE=5 BUILD_GROUP=6 CLEAR_GROUP=7 START=10
        STOP=11 STO_STOP=12 RESTART_STEP_ON=13 M_FUNC_QUIT=20 READ_R_PARA=30 WRITE_R_PARA=40
        """,
    ),
    "E_NCI_STATE": (
        "UINT",
        """
        NULL=0 INIT=1 IDLE=2 RESET=3 LOAD_PROG=4 FEED_TABLE=5 BUILD_GROUP=6 CLEAR_GROUP=7 START=10
        STOP=11 STO_STOP=12 RESTART_STEP_ON=13 M_FUNC_QUIT=20 READ_R_PARA=30 WRITE_R_PARA=40
        """,
    ),
    "E_NCI_INTERPRETER_STATE": (
        "DWORD",
        """
        NCI_INTERPRETER_INITFAILED=0 NCI_INTERPRETER_IDLE=1 NCI_INTERPRETER_READY=2
        NCI_INTERPRETER_STARTED=3 NCI_INTERPRETER_SCANNING=4 NCI_INTERPRETER_RUNNING=5
        NCI_INTERPRETER_STAY_RUNNING=6 NCI_INTERPRETER_WRITETABLE=7 NCI_INTERPRETER_SEARCHLINE=8
        NCI_INTERPRETER_END=9 NCI_INTERPRETER_SINGLESTOP=10 NCI_INTERPRETER_ABORTING=11
        NCI_INTERPRETER_ABORTED=12 NCI_INTERPRETER_FAULT=13 NCI_INTERPRETER_RESET=14
        NCI_INTERPRETER_STOP=15 NCI_INTERPRETER_WAITFUNC=16 NCI_INTERPRETER_FLUSHBUFFERS=17
        """,
    ),
    "E_NCI_CHANNEL_ERROR": (
        "INT",
        """
        e_Null=0 e_InvalidReference_ChannelRef=1 e_AxisConfigurationMismatch_McAxis=2
        e_AxisConfigurationMismatch_AuxAxis=3
        """,
    ),
    "E_CHECK_STATE": (
        "UINT",
        """
        CHECK_INIT=0 AXIS_INDEX_OUT_OF_RANGE=10 AXIS_REF_POINTER_INVALID=100
        AXIS_CTRL_POINTER_INVALID=101 AXIS_STATE_POINTER_INVALID=102 AXIS_INFO_POINTER_INVALID=103
        AXIS_DATA_POINTER_INVALID=104 AXIS_NC_PARAMETER_POINTER_INVALID=105
        AXIS_HOME_PARAMETER_POINTER_INVALID=106 AXIS_GEAR_IN_PARAMETER_POINTER_INVALID=107
        AXIS_GEAR_IN_MULTIMASTER_POINTER_INVALID=108 AXIS_MOTION_OPTIONS_POINTER_INVALID=109
        NCI_NOT_ACTIVATED=200 NCI_CHANNEL_REF_POINTER_INVALID=201
        NCI_AXIS_CONFIG_POINTER_INVALID=202 NCI_MCS_AXIS_POINTER_INVALID=203
        NCI_AUX_AXIS_POINTER_INVALID=204 NCI_CTRL_POINTER_INVALID=205 NCI_STATE_POINTER_INVALID=206
        NCI_R_PARAMETER_READ_POINTER_INVALID=207 NCI_R_PARAMETER_wRITE_POINTER_INVALID=208
        NCI_M_FUNC_POINTER_INVALID=209 CAM_NOT_ACTIVATED=300 CAM_SLAVE_AXIS_REF_INVALID=301
        CAM_SLAVE_ITF_MC_AXIS_INVALID=302 CAM_MASTER_AXIS_REF_INVALID=303
        CAM_MOTION_FUNCTION_POINTER_INVALID=304 CAM_MOTION_FUNCTION_POINT_POINTER_INVALID=305
        AXIS_LIMIT_SWITCHES_POINTER_INVALID=306 FLYING_SAW_NOT_ACTIVATED=400
        FLYING_SLAVE_ITF_MC_AXIS_INVALID=401 FLYING_MASTER_AXIS_REF_INVALID=402
        FLYING_FLY_DATA_POINTER_INVALID=403 FLYING_MOVE_DATA_POINTER_INVALID=404
        FLYING_OPTIONS_POINTER_INVALID=405 FLYING_OPTIONS_SYNCMODE_SIZE_NOT_EQUAL=406
        PARAMETER_SELECTOR=500 PARAMETER_SELECTOR_CTRL_REF_INVALID=501
        PARAMETER_SELECTOR_STATE_REF_INVALID=502 PARAMETER_SELECTOR_AXIS_ITF_INVALID=503
        CHECK_DONE=10000
        """,
    ),
    "E_XFC_CHECK": (
        "INT",
        """
        XFC_CHECK_NONE=0 XFC_CHECK_REF_AXIS=900 XFC_CHECK_REF_AXIS_ITF=901 XFC_CHECK_AXIS_INDEX=902
        XFC_CHECK_DONE=1000
        """,
    ),
    "E_MESSAGE_CHECK": (
        "UINT",
        """
        MSG_CHECK_INVALID_POINTER=9000 MSG_CHECK_INVALID_POINTER_TIME=9001
        MSG_CHECK_INVALID_POINTER_LIST=9002 MSG_CHECK_INVALID_POINTER_MSG_IDX=9003
        MSG_CHECK_INVALID_POINTER_ERR_IDX=9004 MSG_CHECK_INVALID_POINTER_ROOT_FILE=9005
        MSG_CHECK_INVALID_POINTER_ROOT_DIR=9006 MSG_CHECK_INVALID_POINTER_CTRL=9007
        MSG_CHECK_INVALID_POINTER_STATE=9008 MSG_CHECK_DONE=10000
        """,
    ),
    "E_MessageType": (
        "DINT",
        """
        eMessageEmpty=0 eMessageBatch=1 eMessageError=2 eMessageWarning=3 eMessageInfo=4
        eMessageVerbose=5 eMessageSentient=6
        """,
    ),
    "E_MESSAGE_CTRL": (
        "UINT",
        """
        MSG_CTRL_NULL=0 MSG_CTRL_INIT=10 MSG_CTRL_IDLE=30 MSG_CTRL_WRITE=50
        """,
    ),
    "E_MESSAGE_STATE": (
        "UINT",
        """
        MSG_STATE_NULL=0 MSG_STATE_INIT=10 MSG_STATE_IDLE=30 MSG_STATE_WRITE=50
        """,
    ),
    "E_MESSAGE_FLOW": (
        "UINT",
        """
        MSG_FLOW_INIT=0 MSG_FLOW_ROOT=10 MSG_FLOW_ROOT_CREATE=11 MSG_FLOW_ROOT_CREATE_BUSY=12
        MSG_FLOW_FOLDER=13 MSG_FLOW_FOLDER_CREATE=14 MSG_FLOW_FOLDER_CREATE_BUSY=15
        MSG_FLOW_FILE_CREATE_DONE=16 MSG_FLOW_LINE_START=100 MSG_FLOW_LINE_BUILD=101
        MSG_FLOW_LINE_CHECK=102 MSG_FLOW_WRITE_FILE_BUSY=200 MSG_FLOW_WRITE_FILE_END=201
        MSG_FLOW_WRITE_FILE_DONE=1000
        """,
    ),
    "E_MESSAGE_BATCH": (
        "UINT",
        """
        MSG_BATCH_NULL=0 MSG_BATCH_JOB_STARTED=1 MSG_BATCH_NEXT_IN_JOB=2 MSG_BATCH_JOB_DONE=3
        """,
    ),
    "e_Device": (
        "UDINT",
        """
        Device_Null=0 Device_Main=1 Device_MainAxis=2 Device_Nci=3 Device_Cam=4 Device_Functions=5
        Device_FlyingSaw=6 Device_MainApplication=7 Device_MoverSelector=8
        Device_ParameterSelector=9 Device_Configuration=10 Device_XmlData=11 Device_Utilities=12
        General=1000 CaGroup=2000 Xpu=3000 XpuCtrl=4000 Mover=5000 MoverCtrl=6000
        XtsTransportUnit=7000 XfcTriggerBox=8000 XfcTouchProbe=9000 XtsStation=10000 Camming=11000
        NciChannel=12000 NciChannelCtrl=13000 Axis=14000 XfcAxis=15000 MetricsXts=16000
        MetricsAxis=17000 FlyingSaw=18000 Process=20000 ProcessListCtrl=21000 TicketListCtrl=22000
        Application=30000 DataProduct=40000
        """,
    ),
    "e_Subdevice": (
        "DINT",
        """
        General=0 MainInit=1 fbPower=2 fbReset=3 fbResetSercos=4 fbHalt=5 fbStop=6 fbHome=7 fbJog=8
        fbMoveVelocity1=9 fbMoveVelocity2=10 fbMoveAbsolute1=11 fbMoveAbsolute2=12 fbMoveEndless=13
        fbMovePtP=14 fbMoveVelo=15 fbCaGroup=30 fbMoveToPosCa=31 fbSendToAbsPosCa=32
        fbSendToModuloPosCa=33 fbGearInPosCa=34 fbGroupAddAxis=35 fbGroupRemoveAxis=36
        fbGroupDisable=37 fbGroupEnable=38 fbGroupErrorRead=39 fbGroupStatusRead=40 fbGroupReset=41
        fbGroupStop=42 fbHaltCa=43 fbSendToPos=44 fbGearIn=50 fbGearOut=51 fbGearInMultiMaster=52
        fbGearInPos=53 fbGearInVelo=54 fbCamOut=80 fbCamInV2=81 fbCamScalingV2=82 fbCamInfoV2=83
        fbReadMotionFunction=84 fbReadMotionFunctionPoint=85 fbReadMotionFunctionValues=86
        fbWriteMotionFunction=87 fbWriteMotionFunctionPoint=88 fbSetOnlineChangeMode=89
        fbReadParameter=100 fbReadBoolParameter=101 fbWriteParameter=102 fbWriteBoolParameter=103
        fbWriteParameterPersistent=104 fbBuildGroup=200 fbClearGroup=201 fbLoadProg=202
        fbResetItp=203 fbStartStopItp=204 fbEStopItp=205 fbStepOnAfterEStopItp=206
        fbConfirmHskItp=207 fbDelDtgItp=208 fbNciFeedTablePreparation=209 fbNciFeedTable=210
        fbReadLine=211 fbItpReadRParams=212 fbItpWriteRParams=213 Get_ItpState=214 Get_Error=215
        XfcPositionAtTime=300 XfcTimeOfPosition=301 XfcTimeToPosition=302
        XfcTimeToModuloPosition=303 XfcRecordedPosition=304 XfcTouchProbe=305
        XfcTouchProbeEL1258=306 XfcTouchProbeOptions=307 XfcTriggerRef=308 XfcTriggerRef_MT=309
        XfcEl1258Interface_MT=310 XfcRecordedPosition_MT=311 XfcTriggerOut=312 XfcTriggerStart=313
        XfcSwitchOn_2252=314 XfcSwitchOff_2252=315 XfcInit=316 XfcLatchPosition=317
        XfcWaitForPosition=318 AxisMode=1000 AxisControl=1001 AxisStartUp=1002 AxisCycle=1003
        AxisIdle=1004 NciControl=2000 NciStartUp=2001 NciCycle=2002 NciIdle=2003
        FlyingSawControl=2100 FlyingSawStartUp=2101 StationLinkedList=3000 StationInitList=3001
        StationAddHead=3002 StationAddTail=3003 StationGetHead=3004 StationRemoveHeadValue=3005
        StationGearInDistanceToSync=3006 StationGearInSyncStart=3007 StationGearInSyncMove=3008
        StationGearInSyncEnd=3009 StationCalcInfeedPosition=3010 StationControl=4000
        StationState=4001 Xpu_fbEnvironment=5000 Xpu_fbProcessingUnit=5001 Xpu_fbXpuPart=5002
        Xpu_fbXpuTrack=5003 Xpu_fbMc2CaGroup=5004 Xpu_fbParameterSet=5005 Xpu_fbNctController=5006
        Xpu_fbPartModules=5500 Xpu_fbMoverXpu=6000 Xpu_fbNctBaseUnit=6500 TransportUnit_General=7000
        TransportUnit_Restart=7010 TransportUnit_Start=7011 TransportUnit_XpuInit=7012
        TransportUnit_StationClearOutfeed=7013 CamControl=8000 CamStartUp=8001 CamCycle=8002
        Process_StationCollector=11000 Process_ProcessCollector=11100
        Process_ProcessCollector_Init=11101 Process_ProcessCollector_Cycle=11102
        Process_ProcessCollector_Control=11103 Process_LinkedList_GetHead=11104
        Process_LinkedList_RemoveHead=11105 Process_LinkedList_AddTail=11106
        Process_LinkedList_CheckData=11107 Process_StationQueue_Check=11108
        Process_LinkedList_Com=11200 Process_LinkedList_Com_Init=11201
        Process_LinkedList_Com_Cmd=11202 Process_LinkedList_Com_AddHead=11203
        Process_LinkedList_Com_AddTail=11204 Process_LinkedList_Com_DelHead=11205
        Process_LinkedList_Com_DelTail=11206 Process_LinkedList_Com_GetHead=11207
        Process_LinkedList_Com_GetTail=11208 Instance_Command=12000 Instance_ProcessConductor=12001
        Instance_BufferInfeed=12002 Instance_Infeed=12003 Instance_BufferOutfeed=12004
        Instance_Outfeed=12005 Instance_Sender_Buffer=12006 Ticket_LinkedList_Ctrl=12100
        Ticket_LinkedList_Com_Init=12101 Ticket_LinkedList_Com_Cmd=12102
        Ticket_LinkedList_Com_AddHead=12103 Ticket_LinkedList_Com_AddTail=12104
        Ticket_LinkedList_Com_DelHead=12105 Ticket_LinkedList_Com_DelTail=12106
        Ticket_LinkedList_Com_GetHead=12107 Ticket_LinkedList_Com_GetTail=12108 Application=13000
        Application_Check=13001 Application_Clear=13002 Application_Cmd=13003
        Application_Disable=13004 Application_Enable=13005 Application_Finish=13006
        Application_Init=13007 Application_Proceed=13008 Application_Work=13009
        """,
    ),
    "E_AxisEncoderType": (
        "UDINT",
        """
        NoEncoder=0 Simulation_Encoder=1 M3000_Enc=2 M31x0_M2000_Enc=3 MDP_511_Enc=4
        MDP_500_501_Enc=5 MDP_510_Enc=6 KL30xx_Enc=7 SERCOS_EtherCAT_SoE_Pos=8
        SERCOS_EtherCAT_SoE_Pos_Velo=9 Binary_Enc=10 M2510_Enc=11 FOX50_Enc=12 AX2000_Lightbus=14
        Provi_DriveMC_Simodrive_611U=15 Universal_Encoder_varBitmask=16 NC_Backplane=17
        spec_CANopen_Typ=18 MDP_513_DS402=19 AX2xx_B900=20 KL5151_Encoder=21 IP5209_Encoder=24
        KL2531_KL2541_Encoder=25 KL2532_KL2542_Encoder=26 Time_Base_Encoder=27
        TCom_Encoder_SoftDrive=28
        """,
    ),
    "E_AXIS_SELECTOR": (
        "INT",
        """
        SELECT_INDEX=0 SELECT_AXIS_ID=1
        """,
    ),
    "MC_Direction": (
        "INT",
        """
        MC_Positive_Direction=1 MC_Shortest_Way=2 MC_Negative_Direction=3 MC_Current_Direction=4
        MC_Undefined_Direction=128
        """,
    ),
    "MC_BufferMode": (
        "UINT",
        """
        MC_Aborting=0 MC_Buffered=1 MC_BlendingLow=18 MC_BlendingPrevious=19 MC_BlendingNext=20
        MC_BlendingHigh=21
        """,
    ),
    "MC_HomingMode": (
        "INT",
        """
        MC_DefaultHoming=0 MC_AbsSwitch=1 MC_LimitSwitch=2 MC_RefPulse=3 MC_Direct=4 MC_Absolute=5
        MC_Block=6 MC_ForceCalibration=7 MC_ResetCalibration=8
        """,
    ),
    "E_EncoderReferenceMode": (
        "UDINT",
        """
        ENCODERREFERENCEMODE_DEFAULT=0 ENCODERREFERENCEMODE_PLCCAM=1
        ENCODERREFERENCEMODE_HARDWARESYNC=2 ENCODERREFERENCEMODE_HARDWARELATCHPOS=3
        ENCODERREFERENCEMODE_HARDWARELATCHNEG=4 ENCODERREFERENCEMODE_SOFTWARESYNC=5
        ENCODERREFERENCEMODE_SOFTDRIVELATCHPOS=6 ENCODERREFERENCEMODE_SOFTDRIVELATCHNEG=7
        ENCODERREFERENCEMODE_APPLICATION=20
        """,
    ),
    "E_GearInMultiMasterSyncMode": (
        "INT",
        """
        VELOSYNC=0 POSSYNC1=1 POSSYNC2=2
        """,
    ),
    "E_GearInSyncMode": (
        "INT",
        """
        GEARINSYNCMODE_POSITIONBASED=0 GEARINSYNCMODE_TIMEBASED=1
        """,
    ),
    "MC_InterpolationType": (
        "UINT",
        """
        MC_INTERPOLATIONTYPE_LINEAR=0 MC_INTERPOLATIONTYPE_SPLINE=2
        MC_INTERPOLATIONTYPE_SLIDINGSPLINE=3
        """,
    ),
    "MC_CamOperationMode": (
        "UINT",
        """
        CAMOPERATIONMODE_DEFAULT=0 CAMOPERATIONMODE_ADDITIVE=1 CAMOPERATIONMODE_EXCHANGE=2
        CAMOPERATIONMODE_REMOVE=3
        """,
    ),
    "MC_CamScalingMode": (
        "UINT",
        """
        MC_CAMSCALING_USERDEFINED=0 MC_CAMSCALING_AUTOOFFSET=1 MC_CAMSCALING_OFF=2
        """,
    ),
    "MC_CamActivationMode": (
        "UINT",
        """
        MC_CAMACTIVATION_INSTANTANEOUS=0 MC_CAMACTIVATION_ATMASTERCAMPOS=1
        MC_CAMACTIVATION_ATMASTERAXISPOS=2 MC_CAMACTIVATION_NEXTCYCLE=3
        MC_CAMACTIVATION_NEXTCYCLEONCE=4 MC_CAMACTIVATION_ASSOONASPOSSIBLE=5 MC_CAMACTIVATION_OFF=6
        MC_CAMACTIVATION_DELETEQUEUEDDATA=7 MC_CAMACTIVATION_ATMASTERAXISPOS_POSITVEDIRECTION=8
        MC_CAMACTIVATION_ATMASTERAXISPOS_NEGATIVEDIRECTION=9 MC_CAMACTIVATION_BUFFERED=10
        """,
    ),
    "MC_TableType": (
        "INT",
        """
        MC_TABLETYPE_EQUIDISTANT=10 MC_TABLETYPE_NONEQUIDISTANT=11 MC_TABLETYPE_MOTIONFUNCTION=22
        MC_TABLETYPE_CHARACTERISTIC=23
        """,
    ),
    "MC_MotionPointType": (
        "INT",
        """
        MOTIONPOINTTYPE_IGNORE=0 MOTIONPOINTTYPE_REST=1 MOTIONPOINTTYPE_VELOCITY=2
        MOTIONPOINTTYPE_TURN=4 MOTIONPOINTTYPE_MOTION=8 MOTIONPOINTTYPE_ADD=3840
        MOTIONPOINTTYPE_ACTIVATION=8192
        """,
    ),
    "MC_MotionFunctionType": (
        "INT",
        """
        MOTIONFUNCTYPE_NOTDEF=0 MOTIONFUNCTYPE_POLYNOM1=1 MOTIONFUNCTYPE_POLYNOM3=3
        MOTIONFUNCTYPE_POLYNOM5=5 MOTIONFUNCTYPE_POLYNOM7=7 MOTIONFUNCTYPE_POLYNOM8=8
        MOTIONFUNCTYPE_POLYNOM9=9 MOTIONFUNCTYPE_SINUSLINIE=10 MOTIONFUNCTYPE_MODSINUSLINIE=11
        MOTIONFUNCTYPE_BESTEHORN=12 MOTIONFUNCTYPE_BESCHLTRAPEZ=13 MOTIONFUNCTYPE_POLYNOM5_MM=15
        MOTIONFUNCTYPE_SINUS_GERADE_KOMBI=16 MOTIONFUNCTYPE_HARMONIC_KOMBI_RT=17
        MOTIONFUNCTYPE_HARMONIC_KOMBI_TR=18 MOTIONFUNCTYPE_HARMONIC_KOMBI_VT=19
        MOTIONFUNCTYPE_HARMONIC_KOMBI_TV=20 MOTIONFUNCTYPE_BESCHLTRAPEZ_RT=21
        MOTIONFUNCTYPE_BESCHLTRAPEZ_TR=22 MOTIONFUNCTYPE_MODSINUSLINIE_VV=23
        MOTIONFUNCTYPE_POLYNOM7_MM=24 MOTIONFUNCTYPE_POLYNOM6STP=27 MOTIONFUNCTYPE_POLYNOM6WDP=28
        MOTIONFUNCTYPE_BESCHLTRAPEZ_RV=38 MOTIONFUNCTYPE_BESCHLTRAPEZ_VR=39
        MOTIONFUNCTYPE_POLYNOM3_VV=40 MOTIONFUNCTYPE_POLYNOM11=41 MOTIONFUNCTYPE_PEISEKAH11=45
        MOTIONFUNCTYPE_STEPFUNCTION=99 MOTIONFUNCTYPE_SPLINE=100 MOTIONFUNCTYPE_SPLINE_NATURAL=101
        MOTIONFUNCTYPE_SPLINE_TANGENTIAL=102 MOTIONFUNCTYPE_SPLINE_PERIODIC=103
        MOTIONFUNCTYPE_SPLINE_LINEAR=120
        """,
    ),
    "E_SignalEdge": (
        "UINT",
        """
        RisingEdge=0 FallingEdge=1
        """,
    ),
    "MC_AxisParameter": (
        "INT",
        """
        CommandedPosition=1 SWLimitPos=2 SWLimitNeg=3 EnableLimitPos=4 EnableLimitNeg=5
        EnablePosLagMonitoring=6 MaxPositionLag=7 MaxVelocitySystem=8 MaxVelocityAppl=9
        ActualVelocity=10 CommandedVelocity=11 MaxAccelerationSystem=12 MaxAccelerationAppl=13
        MaxDecelerationSystem=14 MaxDecelerationAppl=15 MaxJerkSystem=16 MaxJerkAppl=17 AxisId=1000
        AxisVeloManSlow=1001 AxisVeloManFast=1002 AxisVeloMax=1003 AxisAcc=1004 AxisDec=1005
        AxisJerk=1006 MaxJerk=1007 AxisMaxVelocity=1008 AxisRapidTraverseVelocity=1009
        AxisManualVelocityFast=1010 AxisManualVelocitySlow=1011 AxisCalibrationVelocityForward=1012
        AxisCalibrationVelocityBackward=1013 AxisJogIncrementForward=1014
        AxisJogIncrementBackward=1015 AxisEnMinSoftPosLimit=1016 AxisMinSoftPosLimit=1017
        AxisEnMaxSoftPosLimit=1018 AxisMaxSoftPosLimit=1019 AxisEnPositionLagMonitoring=1020
        AxisMaxPosLagValue=1021 AxisMaxPosLagFilterTime=1022 AxisEnPositionRangeMonitoring=1023
        AxisPositionRangeWindow=1024 AxisEnTargetPositionMonitoring=1025
        AxisTargetPositionWindow=1026 AxisTargetPositionMonitoringTime=1027
        AxisEnInTargetTimeout=1028 AxisInTargetTimeout=1029 AxisEnMotionMonitoring=1030
        AxisMotionMonitoringWindow=1031 AxisMotionMonitoringTime=1032 AxisDelayTimeVeloPosition=1033
        AxisEnLoopingDistance=1034 AxisLoopingDistance=1035 AxisEnBacklashCompensation=1036
        AxisBacklash=1037 AxisEnDataPersistence=1038 AxisRefVeloOnRefOutput=1039
        AxisOverrideType=1040 AxisEncoderScalingFactor=1041 AxisEncoderOffset=1042
        AxisEncoderDirectionInverse=1043 AxisEncoderMask=1044 AxisEncoderModuloValue=1045
        AxisModuloToleranceWindow=1046 AxisEnablePosCorrection=1047 AxisPosCorrectionFilterTime=1048
        AxisUnitInterpretation=1049 AxisMotorDirectionInverse=1050 AxisCycleTime=1051
        AxisFastStopSignalType=1052 AxisFastAcc=1053 AxisFastDec=1054 AxisFastJerk=1055
        AxisEncoderScalingNumerator=1056 AxisEncoderScalingDenominator=1057
        AxisMaximumAcceleration=1058 AxisMaximumDeceleration=1059 AxisVeloJumpFactor=1060
        AxisToleranceBallAuxAxis=1061 AxisMaxPositionDeviationAuxAxis=1062
        AxisErrorPropagationMode=1063 AxisErrorPropagationDelay=1064
        AxisCoupleSlaveToActualValues=1065 AxisAllowMotionCmdToSlaveAxis=1066
        AxisAllowMotionCmdToExtSetAxis=1067 AxisEncoderSubMask=1068 AxisEncoderReferenceSystem=1069
        AxisEncoderPositionFilterPT1=1070 AxisEncoderVelocityFilterPT1=1071
        AxisEncoderAccelerationFilterPT1=1072 AxisEncoderMode=1073
        AxisEncoderHomingInvDirCamSearch=1074 AxisEncoderHomingInvDirSyncSearch=1075
        AxisEncoderHomingCalibValue=1076 AxisEncoderReferenceMode=1077 AxisRefVeloOutputRatio=1078
        AxisDrivePositionOutputScaling=1079 AxisDriveVelocityOutputScaling=1080
        AxisDriveVelocityOutputDelay=1081 AxisDriveMinOutputLimitation=1082
        AxisDriveMaxOutputLimitation=1083 AxisTorqueInputScaling=1084 AxisTorqueInputFilterPT1=1085
        AxisTorqueDerivationInputFilterPT1=1086 AxisTorqueOutputScaling=1087
        AxisTorqueOutputDelay=1088 AxisAccelerationOutputScaling=1089
        AxisAccelerationOutputDelay=1090 AxisDrivePosOutputSmoothFilterType=1091
        AxisDrivePosOutputSmoothFilterTime=1092 AxisDrivePosOutputSmoothFilterOrder=1093
        AxisDriveMode=1094 AxisDriftCompensationOffset=1095 AxisPositionControlKv=1096
        AxisCtrlVelocityPreCtrlWeight=1097 AxisControllerMode=1098 AxisCtrlAutoOffset=1099
        AxisCtrlAutoOffsetTimer=1100 AxisCtrlAutoOffsetLimit=1101 AxisSlaveCouplingControlKcp=1102
        AxisCtrlOutputLimit=1103 AxisFadingAccleration=1104 AxisUserDataIdxOffs=1105
        AxisTargetPosition=2000 AxisRemainingTimeToGo=2001 AxisRemainingDistanceToGo=2002
        AxisMcSetPositionOffset=2003 AxisGearRatio=3000 NcSafCycleTime=4000 NcSvbCycleTime=4001
        AxisEncoderMask64=5000 AxisEncoderSubMask64=5001 AxisMasPositionDeviationAuxAxis=32000
        """,
    ),
}
"""By declared name."""
